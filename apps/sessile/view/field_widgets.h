#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sessile/core/fields.h"
#include "sessile/core/vec.h"

/// Fields of ImGui for the kinds of values that parameters have. Each takes the width there is, has no label, and
/// returns whether the value was changed.
namespace sessile::viewer {

bool edit_number(double& value, Range range, std::string_view unit);
bool edit_whole_number(int& value, Range range);
bool edit_vector(Vec3d& value, Range range);
bool edit_switch(bool& value);
bool edit_text(std::string& value);
bool edit_texts(std::vector<std::string>& values);  ///< as one text, with commas
bool edit_numbers(std::vector<double>& values);     ///< as one text, with commas
bool edit_choice(std::size_t& chosen, std::span<const std::string_view> words);

/// The nearest number to 0 that a range holds, for a parameter that had none.
double first_value(Range range);

}  // namespace sessile::viewer
