#include "unit/python.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "unit/temporary_folder.h"

namespace sessile::test {

std::string python_named_by(const char* variable, const std::string& otherwise) {
  const char* const named = std::getenv(variable);
  return named != nullptr ? named : otherwise;
}

std::optional<std::string> python(const std::string& interpreter, const std::string& module,
                                  const std::string& script) {
  if (std::system(fmt::format("{} -c 'import {}' >/dev/null 2>&1", interpreter, module).c_str()) != 0) return {};
  TemporaryFolder folder;
  std::ofstream(folder / "script.py") << script;
  const std::string command =
      fmt::format("{} {} > {}", interpreter, (folder / "script.py").string(), (folder / "out.txt").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << script;
  return read_file(folder / "out.txt");
}

}  // namespace sessile::test
