#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tamp::test
{

/// Reads a trace by what the trace-event format says of one, and knows nothing of what writes it.
class TraceReader
{
 public:
  using Track = std::pair<std::int64_t, std::int64_t>;
  struct Slice {
    std::string name;
    std::string category;
    Track track;
    /// In nanoseconds.
    std::int64_t start = 0;
    std::int64_t end = 0;
    nlohmann::json args;
  };
  struct Arrow {
    std::vector<std::pair<Track, std::int64_t>> begins, ends;
  };

  /// The text is JSON: an array of events, or an object with one.
  explicit TraceReader(const std::string& text)
  {
    file_ = nlohmann::json::parse(text);
    const nlohmann::json& events = file_.is_array() ? file_ : file_.at("traceEvents");
    if (file_.contains("displayTimeUnit")) {
      const auto unit = file_["displayTimeUnit"].get<std::string>();
      expect(unit == "ms" || unit == "ns", "a unit of time that the format does not know: " + unit);
    }
    for (const nlohmann::json& event : events) read(event);
    look_at_names();
    look_at_nesting();
    look_at_arrows();
  }

  /// Violations of the format; at most the first of each kind and event.
  const std::vector<std::string>& problems() const { return problems_; }
  const nlohmann::json& file() const { return file_; }
  const std::vector<Slice>& slices() const { return slices_; }
  std::vector<Slice> slices(const std::string& argument) const
  {
    std::vector<Slice> found;
    std::copy_if(slices_.begin(), slices_.end(), std::back_inserter(found),
                 [&](const Slice& slice) { return slice.args.contains(argument); });
    return found;
  }
  const std::map<std::int64_t, std::string>& processes() const { return processes_; }
  const std::map<Track, std::string>& tracks() const { return tracks_; }
  /// By category, name and id.
  const std::map<std::tuple<std::string, std::string, std::string>, Arrow>& arrows() const { return arrows_; }

 private:
  void expect(bool is_so, const std::string& problem)
  {
    if (!is_so) problems_.push_back(problem);
  }

  static std::int64_t nanoseconds(const nlohmann::json& microseconds)
  {
    return std::llround(microseconds.get<double>() * 1000);
  }

  void read(const nlohmann::json& event)
  {
    const std::string text = event.dump();
    const auto has = [&](const char* key, bool is_right) {
      expect(is_right, std::string("no proper ") + key + ": " + text);
      return is_right;
    };
    if (!has("event", event.is_object())) return;
    if (!has("ph", event.contains("ph") && event["ph"].is_string() && event["ph"].get<std::string>().size() == 1)) {
      return;
    }
    const char phase = event["ph"].get<std::string>()[0];
    if (!has("name", event.contains("name") && event["name"].is_string())) return;
    if (!has("pid", event.contains("pid") && event["pid"].is_number_integer())) return;
    if (!has("args", !event.contains("args") || event["args"].is_object())) return;
    if (phase == 'M') return read_name(event);
    if (!has("tid", event.contains("tid") && event["tid"].is_number_integer())) return;
    if (!has("ts", event.contains("ts") && event["ts"].is_number() && event["ts"].get<double>() >= 0)) return;
    const Track track{event["pid"], event["tid"]};
    const std::int64_t at = nanoseconds(event["ts"]);
    const std::string category = event.value("cat", "");
    if (phase == 'X') {
      if (!has("dur", event.contains("dur") && event["dur"].is_number() && event["dur"].get<double>() >= 0)) return;
      slices_.push_back({event["name"], category, track, at, at + nanoseconds(event["dur"]),
                         event.value("args", nlohmann::json::object())});
    } else if (phase == 's' || phase == 'f') {
      if (!has("id", event.contains("id") && (event["id"].is_number_integer() || event["id"].is_string()))) return;
      has("bp", phase == 's' || event.value("bp", "") == "e");
      Arrow& arrow = arrows_[{category, event["name"], event["id"].dump()}];
      (phase == 's' ? arrow.begins : arrow.ends).push_back({track, at});
    } else {
      expect(phase == 'i' || phase == 'C', "a phase that no trace of this program has: " + text);
    }
  }

  void read_name(const nlohmann::json& event)
  {
    const auto name = event["name"].get<std::string>();
    const nlohmann::json args = event.value("args", nlohmann::json::object());
    const bool sorts = name == "process_sort_index" || name == "thread_sort_index";
    const bool of_track = name == "thread_name" || name == "thread_sort_index";
    expect(sorts || name == "process_name" || name == "thread_name", "unknown metadata: " + event.dump());
    const bool is_complete = (!of_track || event.contains("tid")) &&
                             (sorts ? args.contains("sort_index") && args["sort_index"].is_number_integer()
                                    : args.contains("name") && args["name"].is_string());
    expect(is_complete, "incomplete metadata: " + event.dump());
    if (!is_complete) return;
    if (name == "process_name") processes_[event["pid"]] = args["name"];
    if (name == "thread_name") tracks_[{event["pid"], event["tid"]}] = args["name"];
  }

  void look_at_names()
  {
    for (const Slice& slice : slices_) {
      expect(processes_.contains(slice.track.first), "a process without a name");
      expect(tracks_.contains(slice.track), "a track without a name");
    }
  }

  /// Two slices of a track are apart, or one lies in the other.
  void look_at_nesting()
  {
    std::stable_sort(slices_.begin(), slices_.end(), [](const Slice& a, const Slice& b) {
      return std::tuple(a.track, a.start, -a.end) < std::tuple(b.track, b.start, -b.end);
    });
    std::vector<const Slice*> open;
    for (const Slice& slice : slices_) {
      while (!open.empty() && (open.back()->track != slice.track || open.back()->end <= slice.start)) open.pop_back();
      expect(open.empty() || slice.end <= open.back()->end, "'" + slice.name + "' ends after what it begins in");
      open.push_back(&slice);
    }
  }

  /// Each begins once, ends once, later, and both within a slice.
  void look_at_arrows()
  {
    for (const auto& [key, arrow] : arrows_) {
      const std::string name = std::get<1>(key) + " " + std::get<2>(key);
      expect(arrow.begins.size() == 1 && arrow.ends.size() == 1, "an arrow without one beginning and end: " + name);
      for (const auto& [track, at] : arrow.begins) {
        expect(is_in_slice(track, at), "an arrow that begins nowhere: " + name);
        for (const auto& end : arrow.ends) expect(at <= end.second, "an arrow that leads back in time: " + name);
      }
      for (const auto& [track, at] : arrow.ends) expect(is_in_slice(track, at), "an arrow that ends nowhere: " + name);
    }
  }

  bool is_in_slice(const Track& track, std::int64_t at) const
  {
    return std::any_of(slices_.begin(), slices_.end(), [&](const Slice& slice) {
      return slice.track == track && slice.start <= at && at <= slice.end;
    });
  }

  nlohmann::json file_;
  std::vector<std::string> problems_;
  std::vector<Slice> slices_;
  std::map<std::int64_t, std::string> processes_;
  std::map<Track, std::string> tracks_;
  std::map<std::tuple<std::string, std::string, std::string>, Arrow> arrows_;
};

}  // namespace tamp::test
