#pragma once

#include <variant>

#include "sessile/pressure/iisph.h"

namespace sessile {

/// Every pressure solver a scene can name under "pressure".
using Pressure = std::variant<Iisph>;

}  // namespace sessile
