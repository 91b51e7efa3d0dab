#include <string>

#include "fuzz/targets.h"
#include "sessile/core/error.h"
#include "session_state.h"

namespace sessile::fuzz {
namespace {

std::string once_more(const std::string& json) { return app::session_json(app::session_of(json)); }

}  // namespace

void read_session(std::string_view bytes) {
  const std::string json = once_more(std::string(bytes));
  try {
    // The first turn makes 0 of -0, which jsoncpp takes for a whole number.
    const std::string again = once_more(json);
    must(once_more(again) == again, "what a run has written does not come back from its own JSON");
  } catch (const Error&) {
    must(false, "what a run has written is not read again");
  }
}

}  // namespace sessile::fuzz
