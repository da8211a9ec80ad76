// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace storey::exports {

/// A template with `{{name}}` replaced by the value of that name, in one pass: values may hold
/// braces themselves.
std::string fillPage(std::string_view text, const std::map<std::string_view, std::string>& values);

/// JSON to stand inside of HTML: no string in it ends the script element.
std::string withoutTags(std::string json);

std::string encodeBase64(std::string bytes);

/// A page of HTML as `storey` writes them, whose parts stand between marks `<!--name-->` and
/// `<!--/name-->`.
class Page {
 public:
  explicit Page(std::string text) : text_(std::move(text)) {}
  /// \throws io::Failure (MissingInput, IoError)
  static Page read(const std::string& path);

  /// \throws io::Failure (BadInput), naming `path`, if the page has no such part
  void replacePart(const std::string& path, const std::string& name, const std::string& html);

  /// \throws io::Failure (CannotCreate, IoError)
  void write(const std::string& path) const;

 private:
  std::string text_;
};

/// The bytes of a file. \throws io::Failure (MissingInput, IoError)
std::string readBytes(const std::string& path);

}  // namespace storey::exports
