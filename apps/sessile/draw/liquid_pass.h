#pragma once

namespace sessile::draw {
class LiquidPass {};
}  // namespace sessile::draw
