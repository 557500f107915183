#include "umbrage/report/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <umbrage_texts/gallery_css.hpp>
#include <umbrage_texts/gallery_js.hpp>

#include "umbrage/report/html.hpp"

namespace umbrage::report {
namespace {

const GalleryEntry* entryNamed(const Gallery& gallery, const std::string& name) {
  const auto found = std::ranges::find(gallery.entries, name, &GalleryEntry::name);
  return found == gallery.entries.end() || !found->obstacle.empty() ? nullptr : &*found;
}

/// The truth that an entry is judged by; null: it is one itself, or has no picture.
const GalleryEntry* truthOf(const Gallery& gallery, const GalleryEntry& entry) {
  return entry.error ? entryNamed(gallery, entry.error->truth) : nullptr;
}

std::string milliseconds(double ms) {
  return ms < 10.0     ? fmt::format("{:.2f} ms", ms)
         : ms < 1000.0 ? fmt::format("{:.0f} ms", ms)
                       : fmt::format("{:.1f} s", ms / 1000.0);
}

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 0.0 : double(part) / double(whole); }

std::string percent(double part) {
  return part == 0.0     ? "0"
         : part < 0.0001 ? fmt::format("{:.4f} %", 100.0 * part)
                         : fmt::format("{:.2f} %", 100.0 * part);
}

std::string facts(const std::vector<std::pair<std::string, std::string>>& list) {
  std::string text = "<dl class=\"facts\">\n";
  for (const auto& [what, value] : list) text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(what), escaped(value));
  return text + "</dl>\n";
}

/// A cell that sorts by `value`.
std::string number(double value, const std::string& shown, const char* look = "") {
  return fmt::format("<td class=\"number {}\" data-value=\"{}\">{}</td>", look, value, escaped(shown));
}
const std::string kNoNumber = "<td class=\"number pale\" data-value=\"\">&ndash;</td>";

std::string errorCells(const GalleryEntry& entry) {
  if (!entry.error) return kNoNumber + kNoNumber + kNoNumber;
  const GalleryError& error = *entry.error;
  return number(double(error.differing), fmt::format("{}", error.differing)) +
         number(double(error.astray), fmt::format("{}", error.astray), error.astray == 0 ? "good" : "bad") +
         number(error.rms, fmt::format("{:.4f}", error.rms));
}

std::string costCells(const Gallery& gallery, const GalleryEntry& entry) {
  const GalleryEntry* truth = truthOf(gallery, entry);
  return number(entry.prepareMs, milliseconds(entry.prepareMs)) + number(entry.frameMs, milliseconds(entry.frameMs)) +
         (truth != nullptr && entry.frameMs > 0.0
              ? number(entry.frameMs / truth->frameMs, fmt::format("{:.2f}", entry.frameMs / truth->frameMs))
              : kNoNumber);
}

std::string row(const Gallery& gallery, const GalleryEntry& entry) {
  const auto name = escaped(entry.name);
  if (!entry.obstacle.empty())
    return fmt::format("<tr><td>{}</td>{}{}{}{}{}{}</tr>\n", name, kNoNumber, kNoNumber, kNoNumber, kNoNumber,
                       kNoNumber, kNoNumber);
  return fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td>{1}{2}</tr>\n", name, errorCells(entry),
                     costCells(gallery, entry));
}

std::string table(const Gallery& gallery) {
  std::string text =
      "<h2>Errors and costs</h2>\n<div class=\"wide\"><table>\n<thead><tr><th class=\"sorts\">technique</th>"
      "<th class=\"sorts number\">pixels that differ</th><th class=\"sorts number\">away from every edge</th><th "
      "class=\"sorts number\">RMS error of the light</th>"
      "<th class=\"sorts number\">made ready in</th><th class=\"sorts number\">a frame</th><th class=\"sorts "
      "number\">&times; its truth&rsquo;s frame</th></tr></thead>\n<tbody>\n";
  for (const GalleryEntry& entry : gallery.entries) text += row(gallery, entry);
  return text +
         "</tbody>\n</table></div>\n<p class=\"pale\">A pixel differs where its light is not the truth&rsquo;s; what "
         "rays find is the truth. "
         "Pixels on the border of a shadow or a surface may fall to either side; those away from every such edge are "
         "wrong. "
         "The RMS error is 0 for masks that are equal and 1 for opposite ones. Times are wall-clock, of this machine "
         "and this run.</p>\n";
}

std::string stage(const GalleryEntry& entry, const GalleryEntry* truth) {
  const auto file = escaped(entry.picture);
  const auto name = escaped(entry.name);
  if (truth == nullptr)
    return fmt::format("<div class=\"stage whole\"><img class=\"over\" src=\"{}\" alt=\"The scene by {}\"></div>\n",
                       file, name);
  return fmt::format(
      "<div class=\"stage\"><img class=\"under\" src=\"{0}\" alt=\"The scene by {1}\"><img class=\"over\" src=\"{2}\" "
      "alt=\"The scene by {3}\">"
      "<span class=\"bar\"></span><span class=\"tag left\">{1}</span><span class=\"tag right\">{3}</span></div>\n"
      "<input class=\"slider\" type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"How much of {1} is seen "
      "beside {3}\">\n",
      escaped(truth->picture), escaped(truth->name), file, name);
}

std::string tab(const char* label, const std::string& file, bool slides, bool pressed) {
  if (file.empty()) return {};
  return fmt::format("<button type=\"button\" data-file=\"{}\"{} aria-pressed=\"{}\">{}</button>", escaped(file),
                     slides ? " data-slides" : "", pressed, label);
}

std::string verdict(const GalleryEntry& entry) {
  if (!entry.error) return "<p>What it shows is taken as the truth.</p>\n";
  const GalleryError& error = *entry.error;
  if (error.differing == 0)
    return fmt::format("<p class=\"good\">Every pixel{} equals {}.</p>\n", error.unknown > 0 ? " that it knows" : "",
                       escaped(error.truth));
  const auto differ =
      fmt::format("{} of {} pixels differ from {} ({}), RMS error {:.4f}", error.differing, error.covered,
                  escaped(error.truth), percent(share(error.differing, error.covered)), error.rms);
  if (error.astray == 0) return fmt::format("<p class=\"good\">{}; none of them away from an edge.</p>\n", differ);
  return fmt::format("<p class=\"bad\">{}; {} of them away from every edge.</p>\n", differ, error.astray);
}

std::string unknown(const GalleryEntry& entry) {
  if (!entry.error || entry.error->unknown == 0) return {};
  return fmt::format("<p>{} pixels are not judged: it knows no shadows on what they show.</p>\n", entry.error->unknown);
}

std::string badges(const GalleryEntry& entry) {
  std::string text;
  for (const auto& trait : entry.traits) text += fmt::format("<span class=\"badge\">{}</span>", escaped(trait));
  return text;
}

std::string card(const Gallery& gallery, const GalleryEntry& entry) {
  const auto name = escaped(entry.name);
  const auto words = fmt::format("<h3>{}</h3>\n<p>{}</p>\n", name, escaped(entry.summary));
  if (!entry.obstacle.empty())
    return fmt::format(
        "<article class=\"card\" id=\"{}\"><div class=\"text\">{}<p class=\"pale\">Not shown: "
        "{}</p>\n{}</div></article>\n",
        name, words, escaped(entry.obstacle), badges(entry));
  const GalleryEntry* truth = truthOf(gallery, entry);
  const auto tabs = tab("picture", entry.picture, truth != nullptr, true) +
                    tab("light mask", entry.mask, false, false) + tab("difference", entry.difference, false, false);
  return fmt::format(
      "<article class=\"card\" id=\"{0}\" data-name=\"{0}\">\n{1}<div class=\"tabs\">{2}</div>\n<div "
      "class=\"text\">{3}{4}<p>Made ready in {5}, a frame in {6} "
      "<span class=\"pale\">(median of {7})</span>.</p>\n{8}</div>\n</article>\n",
      name, stage(entry, truth), tabs, words, verdict(entry) + unknown(entry), milliseconds(entry.prepareMs),
      milliseconds(entry.frameMs), entry.frames, badges(entry));
}

}  // namespace

std::string galleryPage(const Gallery& gallery) {
  std::string body =
      fmt::format("<h1>{}</h1>\n<p class=\"pale\">Every technique on one scene, judged pixel by pixel by rays.</p>\n{}",
                  escaped(gallery.title), facts(gallery.facts));
  body += table(gallery) + "<h2>Pictures</h2>\n<div class=\"cards\">\n";
  for (const GalleryEntry& entry : gallery.entries) body += card(gallery, entry);
  body += fmt::format(
      "</div>\n<h2>Make it again</h2>\n<p><code>{}</code></p>\n<p class=\"pale\">The figures are in gallery.json "
      "too.</p>\n",
      escaped(gallery.command));
  return pageText(
      {gallery.title, "umbrage gallery", std::string(texts::kGalleryCss), std::string(texts::kGalleryJs), body});
}

}  // namespace umbrage::report
