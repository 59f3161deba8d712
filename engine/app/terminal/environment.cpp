#include "engine/app/terminal/environment.hpp"

#include <langinfo.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <clocale>
#include <cstdlib>
#include <string>
#include <system_error>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

std::string environment(char const* name) {
  char const* value = std::getenv(name);
  return value ? value : "";
}

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

int terminal_width(int descriptor) {
  winsize size{};
  if (::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return widest_page;
  return std::clamp<int>(size.ws_col, 20, widest_page);
}

int page_width() {
  constexpr int narrowest_page = 40;  // a column of a tmux window; below it words would be cut
  std::string const asked = environment("COLUMNS");
  int columns = 0;
  if (std::from_chars(asked.data(), asked.data() + asked.size(), columns).ec != std::errc() || columns <= 0)
    columns = terminal_width(STDOUT_FILENO);
  return std::clamp(columns, narrowest_page, widest_page);
}

bool locale_is_utf8() {
  // only the letters: numbers keep their decimal point everywhere
  static bool const utf8 = std::setlocale(LC_CTYPE, "") && std::string(::nl_langinfo(CODESET)) == "UTF-8";
  return utf8;
}

}  // namespace torquescope
