#include "umbrage/report/study_page.hpp"

#include <fmt/format.h>

#include <string_view>
#include <umbrage_texts/study_page_css.hpp>
#include <umbrage_texts/study_page_js.hpp>

#include "umbrage/report/detail/day_chart.hpp"
#include "umbrage/report/html.hpp"

namespace umbrage::report {
namespace {

std::string heading(std::string_view text) { return fmt::format("<h2>{}</h2>\n", escaped(text)); }
std::string note(const std::string& text) {
  return text.empty() ? std::string() : fmt::format("<p class=\"pale\">{}</p>\n", escaped(text));
}

std::string passCell(bool passes) { return passes ? "<td class=\"good\">passes</td>" : "<td class=\"bad\">fails</td>"; }

std::string verdict(const StudyPage& page) {
  if (page.verdict.empty()) return {};
  if (!page.passes) return fmt::format("<div class=\"verdict\"><span>{}</span></div>\n", escaped(page.verdict));
  return fmt::format("<div class=\"verdict {0}\"><strong class=\"{0}\">{1}</strong><span>{2}</span></div>\n",
                     *page.passes ? "good" : "bad", *page.passes ? "Passes" : "Fails", escaped(page.verdict));
}

std::string warnings(const std::vector<std::string>& list) {
  if (list.empty()) return {};
  std::string text = "<div class=\"warnings\">\n";
  for (const auto& line : list) text += fmt::format("<p>{}</p>\n", escaped(line));
  return text + "</div>\n";
}

std::string pairs(const std::vector<std::pair<std::string, std::string>>& list) {
  if (list.empty()) return {};
  std::string text = "<dl class=\"facts\">\n";
  for (const auto& [what, value] : list) text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(what), escaped(value));
  return text + "</dl>\n";
}

std::string tableHead(const std::vector<std::string>& columns) {
  std::string text = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const auto& column : columns) text += fmt::format("<th>{}</th>", escaped(column));
  return text + "</tr></thead>\n<tbody>\n";
}
constexpr std::string_view kTableEnd = "</tbody>\n</table></div>\n";

std::string cells(const std::vector<std::string>& row) {
  std::string text;
  for (const auto& cell : row) text += fmt::format("<td>{}</td>", escaped(cell));
  return text;
}

std::string criteria(const std::vector<Criterion>& list) {
  if (list.empty()) return {};
  std::string text =
      heading("What is asked, and what there is") + tableHead({"requirement", "found", "asked", "margin", ""});
  for (const auto& one : list)
    text += fmt::format("<tr>{}{}</tr>\n", cells({one.what, one.found, one.asked, one.margin}), passCell(one.passes));
  return text.append(kTableEnd);
}

std::string otherwise(const StudyPage& page) {
  if (page.otherwise.empty()) return {};
  std::string text = heading("By other conventions") + note(page.whyOtherwise) +
                     tableHead({"convention", "taken here", "instead", "margin then", "verdict then"});
  for (const auto& one : page.otherwise)
    text += fmt::format("<tr>{}{}</tr>\n", cells({one.convention, one.taken, one.instead, one.margin}),
                        passCell(one.passes));
  return text.append(kTableEnd);
}

std::string table(const PageTable& table) {
  std::string text = heading(table.title) + note(table.note) + tableHead(table.columns);
  for (const auto& row : table.rows) text += fmt::format("<tr>{}</tr>\n", cells(row));
  return text.append(kTableEnd);
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < have ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= have ? kLetters[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string pictures(const std::vector<PagePicture>& list) {
  if (list.empty()) return {};
  std::string text = heading("The shadows of the day");
  if (list.size() > 1)
    text += fmt::format(
        "<div class=\"controls\"><button type=\"button\">Play</button><input type=\"range\" min=\"0\" max=\"{}\" "
        "value=\"0\" aria-label=\"The time\"></div>\n",
        list.size() - 1);
  text += "<div class=\"show\">\n";
  for (std::size_t i = 0; i < list.size(); ++i)
    text +=
        fmt::format("<figure{}><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
                    list.size() == 1 ? " class=\"now\"" : "", escaped(list[i].caption), base64(list[i].png),
                    escaped(list[i].caption));
  return text + "</div>\n";
}

std::string ledger(const std::vector<study::LedgerLine>& lines) {
  if (lines.empty()) return {};
  std::vector<std::pair<std::string, std::string>> list;
  for (const auto& line : lines) list.emplace_back(line.subject, line.text);
  return heading("Conventions: the ledger") + note("They decide what a figure means.") + pairs(list);
}

std::string again(const StudyPage& page) {
  if (page.command.empty()) return {};
  std::string files;
  for (const auto& file : page.evidence) files += (files.empty() ? "" : ", ") + file;
  return heading("Check it") +
         (files.empty() ? std::string() : fmt::format("<p>All figures: {}.</p>\n", escaped(files))) +
         fmt::format("<p><code>{}</code></p>\n", escaped(page.command));
}

}  // namespace

std::string studyPage(const StudyPage& page) {
  std::string body = fmt::format("<h1>{}</h1>\n", escaped(page.title)) + note(page.subtitle) + verdict(page) +
                     warnings(page.warnings) + pairs(page.facts) + criteria(page.criteria) + otherwise(page);
  for (const auto& map : page.maps) body += heading(map.title) + "<div class=\"map\">" + map.svg + "</div>\n";
  for (const auto& chart : page.charts) body += heading(chart.title) + note(chart.note) + detail::chartSvg(chart);
  body += pictures(page.pictures);
  for (const auto& one : page.tables) body += table(one);
  if (!page.sources.empty()) body += heading("Where the rule comes from") + pairs(page.sources);
  body += ledger(page.ledger) + again(page);
  return pageText(
      {page.title, "umbrage study", std::string(texts::kStudyPageCss), std::string(texts::kStudyPageJs), body});
}

}  // namespace umbrage::report
