// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string_view>

#include "attribute_lines.h"
#include "samples.h"
#include "table_files.h"
#include "texel_pack.h"

namespace kiln::io {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Words of C and C++ that no variable may be named by; those that hold a '_' are left out.
constexpr std::string_view keywords[] = {
    "alignas",  "alignof",  "and",       "asm",       "auto",      "bitand",    "bitor",
    "bool",     "break",    "case",      "catch",     "char",      "class",     "compl",
    "concept",  "const",    "consteval", "constexpr", "constinit", "continue",  "decltype",
    "default",  "delete",   "do",        "double",    "else",      "enum",      "explicit",
    "export",   "extern",   "false",     "float",     "for",       "friend",    "goto",
    "if",       "inline",   "int",       "long",      "mutable",   "namespace", "new",
    "noexcept", "not",      "nullptr",   "operator",  "or",        "private",   "protected",
    "public",   "register", "requires",  "restrict",  "return",    "short",     "signed",
    "sizeof",   "static",   "struct",    "switch",    "template",  "this",      "throw",
    "true",     "try",      "typedef",   "typeid",    "typename",  "typeof",    "union",
    "unsigned", "using",    "virtual",   "void",      "volatile",  "while",     "xor",
    "main"};

// Letters and digits with single '_' between, a letter first.
std::string identifier(std::string_view stem) {
  std::string name;
  for (const char c : stem) {
    if (is_letter(c) || is_digit(c)) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  if (name.empty()) return "table";
  if (!is_letter(name.front())) name.insert(0, "table_");
  const bool taken =
      std::find(std::begin(keywords), std::end(keywords), name) != std::end(keywords);
  return taken ? "table_" + name : name;
}

// No comment begins or ends inside the text, nor a trigraph.
std::string inside_comment(std::string text) {
  for (const std::string_view mark : {"*/", "/*", "?\?/"}) {
    for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark)) {
      text.insert(at + 1, 1, ' ');
    }
  }
  return text;
}

std::string_view meaning(PixelType type) {
  switch (type) {
    case PixelType::Uint8:
      return "value = entry / 255";
    case PixelType::Uint16:
      return "value = entry / 65535";
    case PixelType::Half:
      return "entries are the bits of IEEE 754 binary16 (half) numbers";
    default:
      return "entries are the values";
  }
}

std::string_view element(PixelType type) {
  if (type == PixelType::Uint8) return "unsigned char";
  return type == PixelType::Float ? "float" : "unsigned short";
}

// 9 digits give every float back.
void append_float(float value, std::string& text) {
  if (std::isnan(value)) {
    text += "NAN";
  } else if (std::isinf(value)) {
    text += value > 0 ? "INFINITY" : "-INFINITY";
  } else {
    const size_t from = text.size();
    fmt::format_to(std::back_inserter(text), "{:.9g}", value);
    if (text.find_first_of(".e", from) == std::string::npos) text += ".0";
    text += 'f';
  }
}

template <class Integer>
void append_integer(const char* at, std::string& text) {
  Integer value;
  std::memcpy(&value, at, sizeof value);
  fmt::format_to(std::back_inserter(text), "{}", value);
}

void append_number(const char* at, PixelType type, std::string& text) {
  if (type == PixelType::Float) {
    float value = 0;
    std::memcpy(&value, at, sizeof value);
    append_float(value, text);
  } else if (type == PixelType::Uint8) {
    append_integer<uint8_t>(at, text);
  } else {
    append_integer<uint16_t>(at, text);
  }
}

bool has_odd_floats(const std::string& texels) {
  for (size_t at = 0; at + 4 <= texels.size(); at += 4) {
    float value = 0;
    std::memcpy(&value, texels.data() + at, sizeof value);
    if (!std::isfinite(value)) return true;
  }
  return false;
}

// One row of the table between braces, several texels a line.
void append_row(const char* at, const Contents& contents, PixelType type, std::string& text) {
  constexpr size_t numbers_of_line = 8;
  const auto channels = static_cast<size_t>(contents.channels);
  const size_t texels_of_line = std::max<size_t>(1, numbers_of_line / channels);
  const auto width = static_cast<size_t>(contents.slice.width);
  text += "  {";
  for (size_t x = 0; x < width; ++x) {
    if (x > 0) text += x % texels_of_line == 0 ? ",\n   " : ", ";
    text += '{';
    for (size_t c = 0; c < channels; ++c, at += sample_bytes(type)) {
      if (c > 0) text += ", ";
      append_number(at, type, text);
    }
    text += '}';
  }
  text += '}';
}

std::string leading_comment(const std::string& name, const Contents& contents,
                            const StoredPlanes& stored, const WriteOptions& options) {
  std::string text = "/*\n";
  const std::string depth = contents.depth > 1 ? "[z]" : "";
  text += inside_comment(fmt::format(" * {}{}[y][x][channel], channels {}; {}.\n", name, depth,
                                     fmt::join(stored.names, ", "), meaning(options.type)));
  for (const auto& [key, value] : options.attributes) {
    text += inside_comment(comment_line(" * ", key, value));
  }
  return text += " */\n";
}

std::string declaration(const std::string& name, const Contents& contents, PixelType type) {
  std::string text = fmt::format("static const {} {}", element(type), name);
  if (contents.depth > 1) text += fmt::format("[{}]", contents.depth);
  return text + fmt::format("[{}][{}][{}] = {{\n", contents.slice.height, contents.slice.width,
                            contents.channels);
}

class CHeaderEncoder : public BandEncoder {
 public:
  CHeaderEncoder(const FileToWrite& file, const Contents& contents, const StoredPlanes& layout)
      : file_(file), contents_(contents) {
    const std::string name = identifier(file.path.stem().string());
    guard_ = name + "_h";
    std::transform(guard_.begin(), guard_.end(), guard_.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    file_.out.append(leading_comment(name, contents, layout, file.options));
    file_.out.append(fmt::format("#ifndef {0}\n#define {0}\n\n", guard_));
    include_at_ = file_.out.position();
    file_.out.append(declaration(name, contents, file.options.type));
  }

  void add(const StoredPlanes& band) override {
    const Size size = band.size();
    const PixelType type = file_.options.type;
    const std::string texels = packed_texels(size, band, contents_.channels, type, file_.facts);
    if (type == PixelType::Float && !includes_math_ && has_odd_floats(texels)) include_math();
    const size_t row_bytes = texels.size() / static_cast<size_t>(size.height);
    for (int y = 0; y < size.height; ++y, ++written_) {
      text_.clear();
      append_line(texels.data() + static_cast<size_t>(y) * row_bytes);
      file_.out.append(text_);
    }
  }

  void finish() override { file_.out.append(fmt::format("}};\n\n#endif /* {} */\n", guard_)); }

 private:
  // Known only once a number asks for it, which may be late and is rare.
  void include_math() {
    file_.out.insert(include_at_, "#include <math.h>\n\n");
    includes_math_ = true;
  }

  void append_line(const char* texels) {
    const int height = contents_.slice.height;
    const bool volume = contents_.depth > 1;
    const int in_slice = written_ % height;
    if (volume && in_slice == 0) text_ += " {\n";
    append_row(texels, contents_, file_.options.type, text_);
    if (volume && in_slice + 1 == height) text_ += "}";
    text_ += written_ + 1 < height * contents_.depth ? ",\n" : "\n";
  }

  FileToWrite file_;
  Contents contents_;
  std::string guard_, text_;
  uint64_t include_at_ = 0;
  bool includes_math_ = false;
  int written_ = 0;
};

}  // namespace

std::unique_ptr<BandEncoder> c_header_encoder(const FileToWrite& file, const Contents& contents,
                                              const StoredPlanes& layout) {
  return std::make_unique<CHeaderEncoder>(file, contents, layout);
}

}  // namespace kiln::io
