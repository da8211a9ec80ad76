// SPDX-License-Identifier: BSD-3-Clause
#include "export/page_text.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include "io/failure.h"
#include "io/input_file.h"
#include "io/limits.h"
#include "io/output_file.h"

namespace storey::exports {

std::string fillPage(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string filled;
  for (std::size_t open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    const std::size_t close = text.find("}}", open);
    filled += text.substr(0, open);
    filled += values.at(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
  return filled.append(text);
}

std::string withoutTags(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at)) {
    json.replace(at, 1, "\\u003c");
  }
  return json;
}

std::string encodeBase64(std::string bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  std::string text(Digits(bytes.cbegin()), Digits(bytes.cend()));
  return text.replace(text.size() - padding, padding, padding, '=');
}

std::string readBytes(const std::string& path) {
  io::InputFile file(path, io::kDefaultMaxFileBytes);
  const std::size_t size = file.size();
  return std::string(reinterpret_cast<const char*>(file.take(size)), size);
}

Page Page::read(const std::string& path) { return Page(readBytes(path)); }

void Page::replacePart(const std::string& path, const std::string& name, const std::string& html) {
  const std::string mark = "<!--" + name + "-->";
  const std::size_t start = text_.find(mark);
  const std::size_t end = text_.find("<!--/" + name + "-->");
  if (start == std::string::npos || end == std::string::npos || end < start) {
    throw io::Failure(io::BadInput, path, "is no report of storey_reconstruct",
                      "run storey_reconstruct again");
  }
  text_.replace(start + mark.size(), end - start - mark.size(), html);
}

void Page::write(const std::string& path) const {
  io::OutputFile file(path);
  file.write(text_);
  file.commit();
}

}  // namespace storey::exports
