#include "driver/run/output_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

OutputSeries::OutputSeries(std::filesystem::path directory, std::string name, std::string extension,
                           Schedule schedule)
    : directory_(std::move(directory)),
      name_(std::move(name)),
      extension_(std::move(extension)),
      schedule_(schedule) {}

bool OutputSeries::due(std::int64_t step, bool last) const {
  return schedule_.due(step) || (last && schedule_.interval > 0);
}

std::filesystem::path OutputSeries::file(std::int64_t step) const {
  return directory_ / relative_file(step);
}

std::string OutputSeries::relative_file(std::int64_t step) const {
  return fmt::format("{}/{}_{:010}.{}", name_, name_, step, extension_);
}

/// The step in a file's name, membrane_0000012345.vtu; no_step for any other name.
std::int64_t OutputSeries::step_of(const std::string& file_name) const {
  const auto digits = file_name.substr(std::min(file_name.size(), name_.size() + 1));
  std::int64_t step = no_step;
  std::from_chars(digits.data(), digits.data() + digits.size(), step);
  return step >= 0 && name_ + "/" + file_name == relative_file(step) ? step : no_step;
}

void OutputSeries::begin() {
  std::filesystem::create_directories(directory_ / name_);
  exchange::write_series(series(), {});
}

void OutputSeries::show(double shear_time) const {
  if (last_ != no_step) exchange::append_to_series(series(), {shear_time, relative_file(last_)});
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
    const auto named = step_of(std::filesystem::path(entry.file).filename().string());
    if (named == no_step || entry.file != relative_file(named)) {
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
    entries.push_back({static_cast<double>(time) * shear_rate, relative_file(*(next - 1))});
  }
  std::filesystem::create_directories(directory_ / name_);
  exchange::write_series(series(), entries);
  last_ = kept.empty() ? no_step : kept.back();
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(directory_ / name_)) {
    const auto name = entry.path().filename().string();
    const auto step = step_of(name);
    const bool is_half = name.starts_with("." + name_ + "_") && name.ends_with(".tmp");
    if (is_half || (step != no_step && !std::ranges::binary_search(kept, step))) left.push_back(entry.path());
  }
  for (const auto& path : left) std::filesystem::remove(path);
}

}  // namespace tanktread::driver
