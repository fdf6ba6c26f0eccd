// SPDX-License-Identifier: GPL-2.0-or-later
#include "event_collector.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "event_time.h"
#include "files/file_error.h"
#include "files/text.h"

namespace LSM::postproc {

namespace {

/// The name of an element without the prefix of its namespace. A file may use any prefix for that
/// of QuakeML, and elements of other namespaces do not have its names.
std::string_view plain_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// An origin or a magnitude.
struct QuakemlPart {
  std::string id;
  Record record = {};
};

struct QuakemlEvent {
  std::int64_t line = 0;
  std::vector<QuakemlPart> origins = {}, magnitudes = {};
  std::string type = {}, origin_id = {}, magnitude_id = {};
};

/// Reads documents, which may follow one another as in files that were joined, and keeps no more
/// than the events of one block. XML has one document in a file: they are parsed as the elements of
/// one, and their declarations as processing instructions.
class QuakemlReader {
 public:
  QuakemlReader(files::Bytes &bytes, Collector &out) : bytes_(bytes), out_(out) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), start, end);
    XML_SetCharacterDataHandler(parser_.get(), characters);
  }

  void read() {
    constexpr std::string_view declaration = "<?xml", instruction = "<?doc";
    parse("<documents>", false);
    std::string text;
    std::vector<char> block(1 << 16);
    while (const std::size_t got = bytes_.read(block.data(), block.size())) {
      text.append(block.data(), got);
      for (std::size_t at = 0; (at = text.find(declaration, at)) != text.npos;)
        text.replace(at, declaration.size(), instruction);
      // A declaration may continue in the next block.
      const std::size_t later = std::min(text.size(), declaration.size() - 1);
      parse(std::string_view(text).substr(0, text.size() - later), false);
      text.erase(0, text.size() - later);
    }
    parse(text, false);
    if (documents_ == 0) out_.fail(line(), "no element found, expected QuakeML");
    parse("</documents>", true);
  }

 private:
  void parse(std::string_view text, bool last) {
    const XML_Status status =
        XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), last);
    for (const QuakemlEvent &event : std::exchange(events_, {})) add(event);
    if (no_quakeml_)
      throw FileError(out_.path() + ": no element eventParameters, expected QuakeML");
    if (status != XML_STATUS_OK || text_between_)
      out_.fail(line(),
                fmt::format("{}, expected QuakeML",
                            text_between_ ? "text outside of elements"
                                          : XML_ErrorString(XML_GetErrorCode(parser_.get()))));
  }

  std::int64_t line() const {
    return static_cast<std::int64_t>(XML_GetCurrentLineNumber(parser_.get()));
  }

  static void start(void *reader, const XML_Char *name, const XML_Char **attributes) {
    static_cast<QuakemlReader *>(reader)->start(plain_name(name), attributes);
  }
  void start(std::string_view name, const XML_Char **attributes) {
    ++depth_;
    text_.clear();
    if (depth_ == 2) has_parameters_ = false;
    if (depth_ == 3) in_parameters_ = name == "eventParameters";
    has_parameters_ = has_parameters_ || (depth_ == 3 && in_parameters_);
    if (depth_ == 4 && in_parameters_ && name == "event") {
      event_.emplace(QuakemlEvent{line()});
      inside_.clear();
    } else if (event_) {
      inside_.append("/").append(name);
      if (inside_ != "/origin" && inside_ != "/magnitude") return;
      std::vector<QuakemlPart> &parts = inside_ == "/origin" ? event_->origins : event_->magnitudes;
      parts.emplace_back();
      for (; *attributes; attributes += 2)
        if (std::string_view(attributes[0]) == "publicID")
          parts.back().id = text::trim(attributes[1]);
    }
  }

  static void end(void *reader, const XML_Char *) { static_cast<QuakemlReader *>(reader)->end(); }
  void end() {
    if (event_ && depth_ > 4) {
      if (std::string *const place = place_of_text(); place && place->empty())
        *place = text::trim(text_);
      inside_.resize(inside_.rfind('/'));
    } else if (event_) {
      events_.push_back(*std::exchange(event_, std::nullopt));
    }
    text_.clear();
    if (--depth_ > 1) return;
    ++documents_;
    no_quakeml_ = no_quakeml_ || !has_parameters_;
  }

  /// Where the text of this element goes; nullptr: it is not wanted.
  std::string *place_of_text() {
    const auto in = [this](std::vector<QuakemlPart> &parts, Field field) {
      return &parts.back().record[field];
    };
    return inside_ == "/origin/time/value"        ? &event_->origins.back().record.time
           : inside_ == "/origin/latitude/value"  ? in(event_->origins, Field::latitude)
           : inside_ == "/origin/longitude/value" ? in(event_->origins, Field::longitude)
           : inside_ == "/magnitude/mag/value"    ? in(event_->magnitudes, Field::magnitude)
           : inside_ == "/type"                   ? &event_->type
           : inside_ == "/preferredOriginID"      ? &event_->origin_id
           : inside_ == "/preferredMagnitudeID"   ? &event_->magnitude_id
                                                  : nullptr;
  }

  static void characters(void *reader, const XML_Char *text, int count) {
    constexpr std::size_t most = 1000;  // more is no number, name or date
    QuakemlReader &self = *static_cast<QuakemlReader *>(reader);
    const std::string_view more(text, static_cast<std::size_t>(count));
    // All but blanks and byte order marks.
    const auto is_letter = [](char c) { return c > ' ' && c < '\x7f'; };
    if (self.depth_ == 1 && std::any_of(more.begin(), more.end(), is_letter))
      self.text_between_ = true;
    if (self.text_.size() < most) self.text_.append(more);
  }

  /// The part that the event prefers, or the first one; nullptr: there is none.
  /// \param found set to false if the file lacks the one that is preferred
  static const QuakemlPart *preferred(const std::vector<QuakemlPart> &parts, const std::string &id,
                                      bool &found) {
    for (const QuakemlPart &part : parts)
      if (!id.empty() && part.id == id) return &part;
    if (!id.empty()) found = false;
    return parts.empty() ? nullptr : &parts.front();
  }

  void add(const QuakemlEvent &event) {
    bool found = true;
    const QuakemlPart *const origin = preferred(event.origins, event.origin_id, found);
    const QuakemlPart *const size = preferred(event.magnitudes, event.magnitude_id, found);
    Record record = origin ? origin->record : Record();
    record[Field::type] = event.type;
    record.has_origin = origin != nullptr;
    record.at = parse_date(record.time, record.problem);
    if (size) record[Field::magnitude] = size->record[Field::magnitude];
    for (const QuakemlPart &part : event.magnitudes)
      if (double other = 0.0; &part != size && text::parse(part.record[Field::magnitude], other))
        record.other_magnitude = std::max(record.other_magnitude, other);
    if (!found) out_.add_unpreferred();
    out_.add(record, event.line);
  }

  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  files::Bytes &bytes_;
  Collector &out_;
  // What is wanted is ASCII. Latin-1 has a meaning for all bytes of whatever else there is.
  std::unique_ptr<XML_ParserStruct, Free> parser_{XML_ParserCreate("ISO-8859-1")};
  int depth_ = 0, documents_ = 0;
  bool has_parameters_ = false, in_parameters_ = false;  // of the document, and of the element
  bool no_quakeml_ = false, text_between_ = false;       // why the file is refused
  std::optional<QuakemlEvent> event_;
  std::vector<QuakemlEvent> events_;  // of the block
  std::string inside_, text_;         // path of the element in the event, and its text so far
};

}  // namespace

void read_quakeml(files::Bytes &bytes, Collector &out) { QuakemlReader(bytes, out).read(); }

}  // namespace LSM::postproc
