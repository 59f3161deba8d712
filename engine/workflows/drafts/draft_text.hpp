#pragma once
// TOML with a comment behind each line: how a drafted job is written.
//
// Width      100 columns; what is longer goes on in comment lines above the setting
// Threads    one object per text

#include <string>
#include <vector>

namespace torquescope {

// "C:\\data\\arm.csv" with its quotes, escaped as TOML wants
std::string toml_text(std::string const& value);
std::string toml_number(double value);  // as many digits as a unit or a rate needs
std::string toml_list(std::vector<std::string> const& texts);

class DraftText {
 public:
  void section(std::string const& header);  // "[recording]", after an empty line
  void setting(std::string const& key, std::string const& value, std::string const& comment = {});
  void to_edit(std::string const& key, std::string const& value, std::string const& comment);  // commented out
  void comment(std::string const& text);

  std::string const& text() const { return text_; }

 private:
  void line(std::string const& begin, std::string const& comment);

  std::string text_;
};

}  // namespace torquescope
