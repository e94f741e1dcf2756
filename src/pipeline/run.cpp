// SPDX-License-Identifier: Apache-2.0
#include "kiln/pipeline/run.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <new>
#include <optional>

#include "inputs.h"
#include "kiln/store/publish.h"
#include "mip_files.h"
#include "outputs.h"
#include "sheet_files.h"

namespace kiln {
namespace {

/// What several tasks read: made when the first asks, let go after the last. Where making it fails,
/// every reader gets the same error.
template <class T>
class Shared {
 public:
  void set_maker(std::function<T()> make) { make_ = std::move(make); }
  void add_reader() { ++readers_; }

  const T& get() {
    if (error_) throw Error(*error_);
    if (!made_) make();
    return *made_;
  }

  void release() {
    if (--readers_ == 0) made_.reset();
  }

 private:
  void make() {
    try {
      made_.emplace(make_());
    } catch (const Error& error) {
      error_ = error;
      throw;
    }
  }

  int readers_ = 0;
  std::function<T()> make_;
  std::optional<T> made_;
  std::optional<Error> error_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Runner {
 public:
  Runner(const Plan& plan, const Watcher& watcher)
      : plan_(plan),
        watcher_(watcher),
        config_(plan.color.config),
        sets_(plan.sets.size()),
        lights_(plan.environments.size()) {
    for (size_t i = 0; i < sets_.size(); ++i) {
      sets_[i].set_maker([this, i] { return load(plan_.sets[i]); });
    }
    for (size_t i = 0; i < lights_.size(); ++i) {
      lights_[i].set_maker([this, i] { return load(i); });
    }
    albedo_.set_maker([this] { return make_albedo_table(plan_.material.surface); });
    for (const Task& task : plan.tasks) count_readers(task);
  }

  Report run() {
    const auto start = std::chrono::steady_clock::now();
    report_.pipeline = plan_.name.empty() ? plan_.file.filename().string() : plan_.name;
    report_.warnings = plan_.warnings;
    for (const std::string& warning : plan_.warnings) warn(warning);
    for (const Task& task : plan_.tasks) report_.tasks.push_back(announce(task));
    Progress progress{0, static_cast<int>(plan_.tasks.size())};
    for (size_t i = 0; i < plan_.tasks.size() && !interrupted(); ++i) {
      TaskRecord& record = report_.tasks[i];
      if (watcher_.began) watcher_.began(record, progress);
      attempt_task(plan_.tasks[i], record);
      if (record.status == TaskRecord::Status::NotRun) break;
      ++progress.done;
      if (watcher_.ended) watcher_.ended(record, progress);
    }
    report_.seconds = seconds_since(start);
    return std::move(report_);
  }

 private:
  void count_readers(const Task& task) {
    if (task.needs.material) sets_[*task.set].add_reader();
    if (task.needs.light) lights_[*task.environment].add_reader();
    if (task.needs.albedo) albedo_.add_reader();
  }

  void release(const Task& task) {
    if (task.needs.material) sets_[*task.set].release();
    if (task.needs.light) lights_[*task.environment].release();
    if (task.needs.albedo) albedo_.release();
  }

  TaskRecord announce(const Task& task) const {
    TaskRecord record;
    record.bake = task.bake;
    if (task.set) record.set = plan_.sets[*task.set].name;
    record.out = task.out;
    return record;
  }

  LoadedSet load(const PlannedSet& set) {
    LoadedSet loaded = load_set(set, plan_.color, config_, wanted_of(set), plan_.max_memory);
    tell(loaded.record);
    return loaded;
  }

  // What the most demanding of its tasks wants.
  Size wanted_of(const PlannedSet& set) const {
    Size wanted{1, 1};
    for (const Task& task : plan_.tasks) {
      if (!task.needs.material || &plan_.sets[*task.set] != &set) continue;
      const Size one = task.needs.material_for;
      if (one.width <= 0) return {};
      wanted = {std::max(wanted.width, one.width), std::max(wanted.height, one.height)};
    }
    return wanted;
  }

  LoadedLight load(size_t environment) {
    LightSettings settings;
    settings.sampled = false;
    for (const Task& task : plan_.tasks) {
      if (task.environment != environment) continue;
      settings.sampled |= task.needs.sampled;
      settings.prefiltered |= task.needs.prefiltered;
    }
    LoadedLight loaded =
        load_light(plan_.environments[environment], plan_.color, config_, settings);
    const EnvironmentRecord& record = loaded.record;
    for (const std::string& warning : record.warnings) warn(record.name + ": " + warning);
    if (watcher_.lit) watcher_.lit(loaded.record);
    report_.environments.push_back(loaded.record);
    return loaded;
  }

  // The one place that catches: a task's failure becomes its record.
  void attempt_task(const Task& task, TaskRecord& record) {
    const auto start = std::chrono::steady_clock::now();
    try {
      bake(task, record);
      record.status = TaskRecord::Status::Baked;
    } catch (const Error& error) {
      record.fault = error;
    } catch (const std::bad_alloc&) {
      record.fault = Error(Fault::Memory, "out of memory");
    } catch (const std::exception& defect) {
      record.fault = Error(Fault::Internal, defect.what());
    }
    if (record.fault) record.status = TaskRecord::Status::Failed;
    release(task);
    record.seconds = seconds_since(start);
    const bool stopped = record.fault && record.fault->fault() == Fault::Interrupted;
    if (stopped) record = announce(task);
  }

  // What is written band by band is given up between two, and its file does not appear.
  void heed_signals(ImageBands& bands) {
    if (!bands.make) return;
    bands.make = [this, make = std::move(bands.make)](int first, int rows) {
      if (interrupted()) throw Error(Fault::Interrupted, "stopped by a signal");
      return make(first, rows);
    };
  }

  void bake(const Task& task, TaskRecord& record) {
    Ingredients ingredients;
    ingredients.surface = plan_.material.surface;
    if (task.needs.material) ingredients.material = &sets_[*task.set].get().svbrdf;
    if (task.needs.light) ingredients.light = lights_[*task.environment].get().made.light.get();
    if (task.needs.albedo) ingredients.albedo = albedo_.get().get();
    ingredients.coded = coded_as;
    std::optional<SetReader> reader;
    if (task.needs.maps.any()) {
      reader.emplace(plan_.sets[*task.set], plan_.color, config_, task.needs.maps);
      ingredients.maps = &reader->bands();
    }
    Baked baked = task.recipe->bake(ingredients);
    for (Artifact& artifact : baked.artifacts) heed_signals(artifact.bands);
    record.notes = baked.notes;
    record.figures = baked.figures;
    add(write_outputs(plan_, task, baked, config_), record);
    if (!reader) return;
    const auto heed = [this] {
      if (interrupted()) throw Error(Fault::Interrupted, "stopped by a signal");
    };
    if (baked.mips) {
      add(write_mips(plan_, task, *baked.mips, *reader, config_, heed), record);
      const auto figures = baked.mips->figures();
      record.figures.insert(record.figures.end(), figures.begin(), figures.end());
    }
    if (baked.sheet) {
      add(write_sheet(plan_, task, *baked.sheet, *reader, config_, heed), record);
      if (baked.sheet->told) tell(baked.sheet->told(), record);
    }
    tell(reader->record());
  }

  static void add(const Written& written, TaskRecord& record) {
    record.outputs.insert(record.outputs.end(), written.outputs.begin(), written.outputs.end());
    record.notes.insert(record.notes.end(), written.notes.begin(), written.notes.end());
  }

  static void tell(const Told& told, TaskRecord& record) {
    record.notes.insert(record.notes.end(), told.notes.begin(), told.notes.end());
    record.figures.insert(record.figures.end(), told.figures.begin(), told.figures.end());
  }

  // Each set once, however many of its tasks read it.
  void tell(const SetRecord& set) {
    const bool told = std::any_of(report_.sets.begin(), report_.sets.end(),
                                  [&](const SetRecord& other) { return other.name == set.name; });
    if (told) return;
    for (const std::string& warning : set.warnings) warn(set.name + ": " + warning);
    if (watcher_.loaded) watcher_.loaded(set);
    report_.sets.push_back(set);
  }

  bool interrupted() {
    if (watcher_.interrupted) report_.signal = watcher_.interrupted();
    return report_.signal != 0;
  }

  void warn(const std::string& warning) const {
    if (watcher_.warned) watcher_.warned(warning);
  }

  const Plan& plan_;
  const Watcher& watcher_;
  ColorConfig config_;
  std::vector<Shared<LoadedSet>> sets_;
  std::vector<Shared<LoadedLight>> lights_;
  Shared<std::shared_ptr<const AlbedoTable>> albedo_;
  Report report_;
};

}  // namespace

Report run_plan(const Plan& plan, Records records, const Watcher& watcher) {
  require_writable_folder(plan.output);
  Report report = Runner(plan, watcher).run();
  if (records == Records::Keep) {
    publish_text(plan.output / ".kiln" / "report.json", report_json(report));
    publish_text(plan.output / ".kiln" / "times.json", times_json(report));
  }
  return report;
}

}  // namespace kiln
