#include "driver/run/output_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

OutputSeries::OutputSeries(std::filesystem::path directory, std::string name,
                           std::vector<std::string> extensions, Schedule schedule)
    : directory_(std::move(directory)),
      name_(std::move(name)),
      extensions_(std::move(extensions)),
      schedule_(schedule) {}

bool OutputSeries::due(std::int64_t step, bool last) const {
  return schedule_.due(step) || (last && schedule_.interval > 0);
}

std::filesystem::path OutputSeries::file(std::int64_t step) const {
  return directory_ / relative_file(step, extensions_.front());
}

std::string OutputSeries::relative_file(std::int64_t step, const std::string& extension) const {
  return fmt::format("{}/{}_{:010}.{}", name_, name_, step, extension);
}

/// The file of a step that is there, relative to the series.
std::string OutputSeries::file_there(std::int64_t step) const {
  for (const auto& extension : extensions_) {
    auto file = relative_file(step, extension);
    if (std::filesystem::exists(directory_ / file)) return file;
  }
  return relative_file(step, extensions_.front());
}

/// The step in a file's name, membrane_0000012345.vtu; no_step for any other name.
std::int64_t OutputSeries::step_of(const std::string& file_name) const {
  const auto digits = file_name.substr(std::min(file_name.size(), name_.size() + 1));
  std::int64_t step = no_step;
  std::from_chars(digits.data(), digits.data() + digits.size(), step);
  const auto is_named = [&](const std::string& extension) {
    return name_ + "/" + file_name == relative_file(step, extension);
  };
  return step >= 0 && std::ranges::any_of(extensions_, is_named) ? step : no_step;
}

void OutputSeries::begin() {
  std::filesystem::create_directories(directory_ / name_);
  exchange::write_series(series(), {});
}

void OutputSeries::show(double shear_time) const {
  if (last_ != no_step) exchange::append_to_series(series(), {shear_time, file_there(last_)});
}

std::vector<std::int64_t> OutputSeries::steps_there() const {
  std::vector<std::int64_t> steps;
  if (!std::filesystem::is_directory(directory_ / name_)) return steps;
  for (const auto& entry : std::filesystem::directory_iterator(directory_ / name_)) {
    const auto step = step_of(entry.path().filename().string());
    if (step != no_step) steps.push_back(step);
  }
  std::ranges::sort(steps);
  return steps;
}

std::vector<std::int64_t> OutputSeries::steps_kept(std::int64_t step, const Schedule& former) const {
  auto steps = steps_there();
  const auto stays = [&](std::int64_t k) { return k == step && (schedule_.due(k) || former.due(k)); };
  std::erase_if(steps, [&](std::int64_t k) { return k >= step && !stays(k); });
  return steps;
}

std::string OutputSeries::remark(std::int64_t step, const std::vector<std::int64_t>& kept) const {
  const auto folder = directory_ / name_;
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw exchange::FileError(fmt::format("{}: is no folder; move it away", folder.string()));
  std::vector<exchange::SeriesEntry> entries;
  try {
    entries = exchange::read_series(series());
  } catch (const exchange::FileError& error) {
    return error.what();
  }
  std::int64_t n_gone = 0;
  for (const auto& entry : entries) {
    const auto name = std::filesystem::path(entry.file).filename().string();
    const auto named = step_of(name);
    if (named == no_step || entry.file != name_ + "/" + name) {
      throw exchange::FileError(
          fmt::format("{}: entry {} is not of this run; remove it", series().string(), entry.file));
    }
    if (named < step && !std::ranges::binary_search(kept, named)) ++n_gone;
  }
  if (n_gone == 0) return "";
  return fmt::format(
      "{}: {} not there", series().string(),
      n_gone == 1 ? "an entry names a file that is" : fmt::format("{} entries name files that are", n_gone));
}

void OutputSeries::cut(const std::vector<std::int64_t>& kept, const std::vector<std::int64_t>& times,
                       double shear_rate) {
  std::vector<exchange::SeriesEntry> entries;
  for (const auto time : times) {
    const auto next = std::ranges::upper_bound(kept, time);
    if (next == kept.begin()) continue;
    // The very number that System::shear_time() gave the run that wrote the file.
    entries.push_back({static_cast<double>(time) * shear_rate, file_there(*(next - 1))});
  }
  std::filesystem::create_directories(directory_ / name_);
  exchange::write_series(series(), entries);
  last_ = kept.empty() ? no_step : kept.back();
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(directory_ / name_)) {
    if (is_left(entry.path(), kept)) left.push_back(entry.path());
  }
  // An index goes before its pieces.
  std::ranges::stable_partition(left, [](const auto& path) { return !std::filesystem::is_directory(path); });
  for (const auto& path : left) std::filesystem::remove_all(path);
}

/// Whether this is of a step that is not kept, or half written.
bool OutputSeries::is_left(const std::filesystem::path& path, const std::vector<std::int64_t>& kept) const {
  const auto name = path.filename().string();
  if (name.starts_with("." + name_ + "_") && name.ends_with(".tmp")) return true;
  if (const auto step = step_of(name); step != no_step) return !std::ranges::binary_search(kept, step);
  // A folder of pieces has the name of its index.
  if (!std::filesystem::is_directory(path)) return false;
  const auto step = step_of(name + "." + extensions_.back());
  if (step == no_step) return false;
  return !std::ranges::binary_search(kept, step) ||
         file_there(step) != relative_file(step, extensions_.back());
}

}  // namespace tanktread::driver
