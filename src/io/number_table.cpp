// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "attribute_lines.h"
#include "coordinate_grid.h"
#include "kiln/core/error.h"
#include "kiln/io/image_file.h"
#include "number_text.h"

namespace kiln::io {
namespace {

[[noreturn]] void refuse(size_t line, const std::string& what) {
  throw Error(Fault::Input, fmt::format("line {}: {}", line, what));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\v\f";
  const size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

struct Line {
  size_t number = 0;  // from 1
  std::string_view text;
};

struct Lines {
  std::vector<Line> lines;  // those with something but a comment
  Attributes attributes;
};

Lines lines_of(std::string_view text) {
  Lines result;
  for (size_t number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with('#')) {
      const auto found = attribute_of(trimmed(line.substr(1)));
      if (found && result.lines.empty()) result.attributes.push_back(*found);
      continue;
    }
    if (line.starts_with("//") || line.starts_with('%')) continue;
    if (line.find('"') == std::string_view::npos) line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) result.lines.push_back({number, line});
  }
  return result;
}

char separator_of(std::string_view line) {
  for (const char one : {'\t', ';', ','}) {
    if (line.find(one) != std::string_view::npos) return one;
  }
  return ' ';
}

// Cells between separators, without quotes; a separator at the end opens no cell.
void split(std::string_view line, char separator, std::vector<std::string>& cells) {
  cells.clear();
  while (!line.empty()) {
    std::string cell;
    if (line[0] == '"') {
      size_t at = 1;
      for (; at < line.size() && (line[at] != '"' || line.substr(at).starts_with("\"\"")); ++at) {
        if (line[at] == '"') ++at;
        cell += line[at];
      }
      line.remove_prefix(std::min(at + 1, line.size()));
    }
    const size_t end = std::min(line.find(separator), line.size());
    cell += trimmed(line.substr(0, end));
    cells.push_back(std::move(cell));
    line = trimmed(line.substr(std::min(end + 1, line.size())));
  }
}

std::optional<NumberText> number_in(std::string& cell, char separator) {
  const size_t comma = cell.find(',');
  if (separator == ';' && comma != std::string::npos) cell[comma] = '.';
  return whole_number(cell);
}

bool is_numeric(std::vector<std::string> cells, char separator) {
  return std::all_of(cells.begin(), cells.end(),
                     [&](std::string& cell) { return number_in(cell, separator).has_value(); });
}

// Rows of numbers one behind the other.
struct Table {
  std::vector<std::string> header;  // of the columns that are numbers; empty without one
  std::vector<double> numbers;
  size_t rows = 0;
  size_t columns = 0;
  bool integers = true;
  bool last_is_short = false;
  std::vector<std::string> notes;
};

// Columns whose first row is a word are left out.
std::vector<bool> numeric_columns(const std::vector<std::string>& header,
                                  std::vector<std::string> first, char separator, Table& table) {
  std::vector<bool> taken;
  for (size_t c = 0; c < first.size(); ++c) {
    taken.push_back(header.empty() || number_in(first[c], separator).has_value());
    if (header.empty()) continue;
    if (taken.back()) {
      table.header.push_back(header[c]);
    } else {
      table.notes.push_back(fmt::format("column '{}' holds words; it was left out", header[c]));
    }
  }
  return taken;
}

void read_row(std::vector<std::string>& cells, const std::vector<bool>& taken, char separator,
              size_t line, Table& table) {
  for (size_t c = 0; c < cells.size(); ++c) {
    if (!taken[c]) continue;
    const auto number = number_in(cells[c], separator);
    if (!number) refuse(line, fmt::format("found '{}', expected a number", cells[c].substr(0, 40)));
    table.numbers.push_back(number->value);
    table.integers = table.integers && number->integer;
  }
  ++table.rows;
}

Table rows_of(const std::vector<Line>& lines, size_t first, char separator,
              const std::vector<std::string>& header) {
  Table table;
  std::vector<std::string> cells;
  split(lines[first].text, separator, cells);
  const std::vector<bool> taken = numeric_columns(header, cells, separator, table);
  table.columns = static_cast<size_t>(std::count(taken.begin(), taken.end(), true));
  for (size_t i = first; i < lines.size(); ++i) {
    split(lines[i].text, separator, cells);
    table.last_is_short =
        i + 1 == lines.size() && header.empty() && i > first && cells.size() < taken.size();
    if (cells.size() != taken.size() && !table.last_is_short) {
      refuse(lines[i].number, fmt::format("found {} columns, expected {} as in line {}",
                                          cells.size(), taken.size(), lines[first].number));
    }
    read_row(cells, taken, separator, lines[i].number, table);
  }
  return table;
}

bool may_be_header(std::string_view line) {
  return line.find_first_of("[]{}=") == std::string_view::npos;
}

NumberArray arranged(Table table) {
  NumberArray array;
  array.stored = table.integers ? NumberArray::Stored::Integer : NumberArray::Stored::Decimal;
  array.notes = std::move(table.notes);
  if (!table.header.empty()) {
    if (auto grid = on_grid(table.header, table.numbers)) {
      array.shape = std::move(grid->shape);
      array.values = std::move(grid->values);
      array.columns = std::move(grid->columns);
      array.channels = std::move(grid->channels);
      return array;
    }
  }
  array.channels = std::move(table.header);
  const bool flat = table.columns == 1 || table.last_is_short;
  array.shape = {static_cast<int>(flat ? table.numbers.size() : table.rows)};
  if (!flat) array.shape.push_back(static_cast<int>(table.columns));
  array.values = std::move(table.numbers);
  return array;
}

}  // namespace

std::optional<NumberArray> read_number_table(std::string_view text) {
  Lines found = lines_of(text);
  if (found.lines.empty()) return std::nullopt;
  const std::string_view first = found.lines.front().text;
  const char separator = separator_of(first);
  std::vector<std::string> cells, header, next;
  split(first, separator, cells);
  size_t first_row = 0;
  if (!is_numeric(cells, separator)) {
    if (found.lines.size() < 2 || !may_be_header(first)) return std::nullopt;
    split(found.lines[1].text, separator, next);
    const bool any = std::any_of(next.begin(), next.end(), [&](const std::string& cell) {
      return is_numeric({cell}, separator);
    });
    if (next.size() != cells.size() || !any) return std::nullopt;
    header = cells;
    first_row = 1;
  }
  NumberArray array = arranged(rows_of(found.lines, first_row, separator, header));
  array.attributes = std::move(found.attributes);
  return array;
}

}  // namespace kiln::io
