// SPDX-License-Identifier: Apache-2.0
#include "json_at.h"

#include <fmt/format.h>

#include <algorithm>

namespace kiln {
namespace {

/// Finds the place of a mistake; all else is let pass.
struct MistakePlace : nlohmann::json_sax<Json> {
  size_t position = 0;
  std::string token;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t at, const std::string& last,
                   const nlohmann::detail::exception&) override {
    position = at;
    token = last;
    return false;
  }
};

std::string printable(const std::string& token) {
  std::string text;
  for (const char c : token.substr(0, 40)) {
    text += c >= ' ' && c < 127 ? std::string(1, c)
                                : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return text;
}

[[noreturn]] void refuse_json(const std::string& text, const std::string& file) {
  MistakePlace place;
  Json::sax_parse(text, &place);
  const size_t end = std::min(place.position > 0 ? place.position - 1 : 0, text.size());
  const auto begin = text.begin(), at = begin + static_cast<std::ptrdiff_t>(end);
  const auto line = std::count(begin, at, '\n') + 1;
  const size_t newline = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const size_t column = newline == std::string::npos ? end + 1 : end - newline;
  const bool ended = end >= text.size();
  throw Error(Fault::Input, fmt::format("{}:{}:{}: this is not JSON: {}", file, line, column,
                                        ended ? std::string("the text ends too early")
                                              : "unexpected '" + printable(place.token) + "'"));
}

std::string kind_of(const Json& value) {
  if (value.is_string()) return "a text";
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  if (value.is_object()) return "an object";
  return value.dump();
}

}  // namespace

Json parse_json(const std::string& text, const std::string& file) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) refuse_json(text, file);
  return json;
}

void JsonAt::refuse(const std::string& message) const {
  throw Error(Fault::Input,
              fmt::format("{}: {}{}{}", file_, where_, where_.empty() ? "" : ": ", message));
}

std::vector<std::string> JsonAt::keys() const {
  std::vector<std::string> keys;
  if (!value_->is_object()) return keys;
  for (auto entry = value_->begin(); entry != value_->end(); ++entry) keys.push_back(entry.key());
  return keys;
}

std::optional<JsonAt> JsonAt::find(const std::string& key) const {
  if (!value_->is_object()) refuse(fmt::format("found {}, expected an object", kind_of(*value_)));
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonAt(*found, file_, where_.empty() ? key : where_ + "." + key);
}

std::vector<JsonAt> JsonAt::items(const std::string& key) const {
  std::vector<JsonAt> items;
  const auto list = find(key);
  if (!list) return items;
  if (!list->value_->is_array()) {
    list->refuse(fmt::format("found {}, expected a list", kind_of(*list->value_)));
  }
  for (const Json& item : *list->value_) {
    items.push_back(JsonAt(item, file_, fmt::format("{}[{}]", list->where_, items.size())));
  }
  return items;
}

double JsonAt::number(const std::string& key, double missing) const {
  const auto found = find(key);
  if (!found) return missing;
  if (!found->value_->is_number()) {
    found->refuse(fmt::format("found {}, expected a number", kind_of(*found->value_)));
  }
  return found->value_->get<double>();
}

std::optional<size_t> JsonAt::index(const std::string& key) const {
  const auto found = find(key);
  if (!found) return std::nullopt;
  if (!found->value_->is_number_unsigned()) {
    found->refuse(fmt::format("found {}, expected a number of an entry", kind_of(*found->value_)));
  }
  return found->value_->get<size_t>();
}

std::string JsonAt::text(const std::string& key, const std::string& missing) const {
  const auto found = find(key);
  if (!found) return missing;
  if (!found->value_->is_string()) {
    found->refuse(fmt::format("found {}, expected a text", kind_of(*found->value_)));
  }
  return found->value_->get<std::string>();
}

std::optional<std::vector<double>> JsonAt::list(const std::string& key, size_t count) const {
  const auto found = find(key);
  if (!found) return std::nullopt;
  const Json& value = *found->value_;
  const bool fits = value.is_array() && value.size() == count &&
                    std::all_of(value.begin(), value.end(),
                                [](const Json& number) { return number.is_number(); });
  if (!fits) found->refuse(fmt::format("found {}, expected {} numbers", kind_of(value), count));
  return value.get<std::vector<double>>();
}

}  // namespace kiln
