#include "engine/app/terminal/environment.hpp"

#include <langinfo.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <cstdlib>

#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

std::string environment(char const* name) {
  char const* value = std::getenv(name);
  return value ? value : "";
}

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

int terminal_width(int descriptor) {
  winsize size{};
  if (::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return page_width;
  return std::clamp<int>(size.ws_col, 20, page_width);
}

bool locale_is_utf8() {
  // only the letters: numbers keep their decimal point everywhere
  static bool const utf8 = std::setlocale(LC_CTYPE, "") && std::string(::nl_langinfo(CODESET)) == "UTF-8";
  return utf8;
}

}  // namespace torquescope
