#pragma once

#include <optional>
#include <string>

namespace sessile::test {

/// The Python that an environment variable names, else `otherwise`.
std::string python_named_by(const char* variable, const std::string& otherwise);

/// What Python says of a script, which must end well; nothing where a module is missing.
std::optional<std::string> python(const std::string& interpreter, const std::string& module, const std::string& script);

}  // namespace sessile::test
