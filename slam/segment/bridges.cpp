#include "slam/segment/bridges.h"

#include <algorithm>
#include <cstddef>

namespace slam {
namespace {

constexpr int kMinCore_px = 40;  // balances small surfaces against specks
constexpr std::int16_t kOther = -2,
                       kOpen = -1;  // in part_at_: not of the component; no part yet

/// Calls visit(pixel, run) for the pixels of the runs of some component.
template <typename Visit>
void VisitPixels(const LabelRuns& runs, const Visit& visit) {
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    const int start = static_cast<int>(row) * runs.width;
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k)
      visit(start + runs.runs[k].begin, start + runs.runs[k].end, k);
  }
}

}  // namespace

void BridgeCutter::FindCores(const LabelComponents& components) {
  FindInterior(components.runs, interior_.runs);
  ConnectRuns(interior_);
  cores_.clear();
  for (std::size_t k = 0; k < interior_.list.size(); ++k) {
    const LabelComponent& core = interior_.list[k];
    if (core.pixels < kMinCore_px) continue;
    const int width = components.runs.width;
    const int of = components.At(core.first_pixel % width, core.first_pixel / width);
    cores_.push_back({of, static_cast<int>(k), core.pixels, -1});
  }
  std::sort(cores_.begin(), cores_.end(), [](const Core& a, const Core& b) {
    if (a.component != b.component) return a.component < b.component;
    return a.pixels != b.pixels ? a.pixels > b.pixels : a.id < b.id;
  });
}

/// Numbers the parts that the cores of a component make: a core is of the part of a larger one
/// that nothing behind separates it from.
int BridgeCutter::NumberParts(std::vector<Core>::iterator first,
                              std::vector<Core>::iterator last, const LabelPlane& plane,
                              double max_behind) {
  int part_count = 0;
  for (auto core = first; core != last; ++core) {
    for (auto larger = first; larger != core && core->part < 0; ++larger) {
      if (between_.ShareBehind(core->id, larger->id, plane) <= max_behind)
        core->part = larger->part;
    }
    if (core->part < 0) core->part = part_count++;
  }
  return part_count;
}

/// Begins with the pixels of the cores.
void BridgeCutter::Seed(const DepthGrid& grid, std::vector<Core>::iterator first,
                        std::vector<Core>::iterator last) {
  part_of_core_.assign(interior_.list.size(), -1);
  for (auto core = first; core != last; ++core)
    part_of_core_[static_cast<std::size_t>(core->id)] = core->part;
  front_.clear();
  VisitPixels(interior_.runs, [&](int begin, int end, std::size_t run) {
    const int core = interior_.component[run];
    if (core < 0 || part_of_core_[static_cast<std::size_t>(core)] < 0) return;
    const int part = part_of_core_[static_cast<std::size_t>(core)];
    std::fill(part_at_.begin() + begin, part_at_.begin() + end,
              static_cast<std::int16_t>(part));
    for (int i = begin; i < end; ++i) front_.push_back(i);
  });
  Spread(grid);
}

/// Gives each open pixel the part that is fewest steps away.
void BridgeCutter::Spread(const DepthGrid& grid) {
  for (std::size_t next = 0; next < front_.size(); ++next) {
    const int i = front_[next];
    const int u = i % grid.width, v = i / grid.width;
    const auto visit = [&](int k) {
      std::int16_t& part = part_at_[static_cast<std::size_t>(k)];
      if (part != kOpen) return;
      part = part_at_[static_cast<std::size_t>(i)];
      front_.push_back(k);
    };
    if (u > 0) visit(i - 1);
    if (u + 1 < grid.width) visit(i + 1);
    if (v > 0) visit(i - grid.width);
    if (v + 1 < grid.height) visit(i + grid.width);
  }
}

/// Makes components of the parts of one: the first keeps its number, the others come last.
void BridgeCutter::Split(const DepthGrid& grid, int component, int part_count,
                         LabelComponents& components) {
  const int first_new = static_cast<int>(components.list.size());
  components.list[static_cast<std::size_t>(component)].pixels = 0;
  const int label = components.list[static_cast<std::size_t>(component)].label;
  components.list.resize(static_cast<std::size_t>(first_new + part_count - 1),
                         {label, 0, 0, 0, 0});

  // Runs are written anew, cut where the part changes.
  split_runs_.width = grid.width;
  split_runs_.runs.clear(), split_runs_.rows.clear(), split_components_.clear();
  VisitPixels(components.runs, [&](int begin, int end, std::size_t run) {
    const int start = begin - components.runs.runs[run].begin;
    if (start == begin) split_runs_.rows.push_back(split_runs_.runs.size());
    const int of = components.component[run];
    for (int next = begin; begin < end; begin = next) {
      int id = of;
      next = end;
      if (of == component) {
        const std::int16_t part = part_at_[static_cast<std::size_t>(begin)];
        for (next = begin + 1; next < end; ++next)
          if (part_at_[static_cast<std::size_t>(next)] != part) break;
        id = part == 0 ? component : first_new + part - 1;
        LabelComponent& to = components.list[static_cast<std::size_t>(id)];
        if (to.pixels == 0) to.first_pixel = begin;
        to.pixels += next - begin;
      }
      split_runs_.runs.push_back(
          {begin - start, next - start, components.runs.runs[run].label});
      split_components_.push_back(id);
    }
  });
  split_runs_.rows.push_back(split_runs_.runs.size());
  std::swap(components.runs, split_runs_);
  std::swap(components.component, split_components_);
}

void BridgeCutter::Cut(const DepthGrid& grid, const std::vector<LabelPlane>& planes,
                       double max_behind, LabelComponents& components) {
  FindCores(components);
  bool looks_between = false, cut = false;
  for (auto first = cores_.begin(), last = first; first != cores_.end(); first = last) {
    const int component = first->component;
    last = std::find_if(first, cores_.end(),
                        [&](const Core& core) { return core.component != component; });

    // Parts that the depth between cores keeps apart.
    if (last - first < 2) continue;
    if (!looks_between) {
      between_.Begin(grid, interior_.runs, interior_.component,
                     static_cast<int>(interior_.list.size()));
    }
    looks_between = true;
    const int label = components.list[static_cast<std::size_t>(component)].label;
    const int part_count =
        NumberParts(first, last, planes[static_cast<std::size_t>(label)], max_behind);
    if (part_count < 2) continue;

    // Its pixels go to the nearest core's part.
    if (!cut) part_at_.assign(grid.q.size(), kOther);
    cut = true;
    VisitPixels(components.runs, [&](int begin, int end, std::size_t run) {
      if (components.component[run] == component)
        std::fill(part_at_.begin() + begin, part_at_.begin() + end, kOpen);
    });
    Seed(grid, first, last);
    Split(grid, component, part_count, components);
  }
  if (cut) CountSides(grid, planes, components);
}

}  // namespace slam
