#include "cli/spelling.h"

#include <algorithm>
#include <regex>

#include "printable.h"
#include "settings/settings.h"

namespace phlux::cli {
namespace {

bool is_option(const std::string& name) {
  return name == "device" || name == "lobe" || name == "set" || name == "size" || name == "moments" ||
         std::ranges::find(settings::all(), name, &settings::Setting::name) != settings::all().end();
}

} // namespace

std::string with_options(const std::string& text) {
  static const std::regex quoted("`([a-z-]+|D)`");
  std::string result;
  auto rest = text.begin();
  for (std::sregex_iterator match(text.begin(), text.end(), quoted), end; match != end; ++match) {
    const std::ssub_match& all = (*match)[0];
    result.append(rest, all.first);
    if ((*match)[1] == "D")
      result += "-D";
    else
      result += is_option((*match)[1]) ? "--" + (*match)[1].str() : all.str();
    rest = all.second;
  }
  return printable(result.append(rest, text.end()), true);
}

} // namespace phlux::cli
