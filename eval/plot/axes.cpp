#include "eval/plot/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace eval {
namespace {

constexpr const char* kFont = "DejaVu Sans";
constexpr double kFont_pt = 8.0, kTick_pt = 3.0, kGap_pt = 3.0;
constexpr double kLine_pt = 0.6;
constexpr double kMarker_pt = 2.2;
constexpr double kGridGrey = 0.88, kBarShade = 0.85;
constexpr double kLegendSample_pt = 16.0, kLegendGap_pt = 12.0, kLegendRow_pt = 12.0;
constexpr double kTicks = 5.0;
constexpr double kTickRoundOff = 1e-9;  // of a step: a tick on the border counts

enum class Anchor { kLeft, kMiddle, kRight };

void SelectFont(cairo_t* context) {
  cairo_select_font_face(context, kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, kFont_pt);
}

double TextWidth(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

void Text(cairo_t* context, double x, double y, const std::string& text, Anchor anchor) {
  const double width = TextWidth(context, text);
  const double shift = anchor == Anchor::kLeft     ? 0.0
                       : anchor == Anchor::kMiddle ? -0.5 * width
                                                   : -width;
  cairo_move_to(context, x + shift, y);
  cairo_show_text(context, text.c_str());
}

std::string TickText(double value) { return fmt::format("{:g}", value == 0.0 ? 0.0 : value); }

std::vector<double> TicksOf(const PlotAxis& axis) {
  if (!axis.categories.empty()) {
    std::vector<double> ticks(axis.categories.size());
    for (std::size_t i = 0; i < ticks.size(); ++i) ticks[i] = static_cast<double>(i);
    return ticks;
  }
  if (!axis.logarithmic) return RoundTicks(axis.min, axis.max);
  std::vector<double> ticks;
  for (double decade = std::pow(10.0, std::floor(std::log10(axis.min))); decade <= axis.max;
       decade *= 10.0) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * decade;
      if (tick >= axis.min && tick <= axis.max) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string TickName(const PlotAxis& axis, double tick) {
  if (axis.categories.empty()) return TickText(tick);
  return axis.categories[static_cast<std::size_t>(tick)];
}

void Widen(PlotAxis& axis) {
  if (axis.max > axis.min) return;
  const double half = axis.min == 0.0 ? 0.5 : 0.5 * std::abs(axis.min);
  axis.min -= half;
  axis.max += half;
}

double Share(const PlotAxis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.min) / (axis.max - axis.min);
  return std::log(value / axis.min) / std::log(axis.max / axis.min);
}

/// Visits each entry with its place in the rows. @returns the height
template <typename Visit>
double LayOutLegend(cairo_t* context, double width, const std::vector<LegendEntry>& entries,
                    const Visit& visit) {
  SelectFont(context);
  double x = 0.0, row = 1.0;
  for (const LegendEntry& entry : entries) {
    const double entry_width =
        kLegendSample_pt + kGap_pt + TextWidth(context, entry.name) + kLegendGap_pt;
    if (x > 0.0 && x + entry_width > width) {
      x = 0.0;
      row += 1.0;
    }
    visit(entry, x, row * kLegendRow_pt);
    x += entry_width;
  }
  return row * kLegendRow_pt + kGap_pt;
}

}  // namespace

SeriesStyle StyleOfSeries(std::size_t number) {
  // Okabe and Ito 2008, without black, which is the truth's, and yellow last, which is pale.
  constexpr std::array<std::array<int, 3>, 7> kColours = {{{0, 114, 178},
                                                           {213, 94, 0},
                                                           {0, 158, 115},
                                                           {204, 121, 167},
                                                           {230, 159, 0},
                                                           {86, 180, 233},
                                                           {240, 228, 66}}};
  const auto& colour = kColours[number % kColours.size()];
  SeriesStyle style{colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0};
  const std::size_t times_through = number / kColours.size();
  style.dash_pt = 2.0 * static_cast<double>(times_through);
  return style;
}

SeriesStyle StyleOfTruth() {
  SeriesStyle style;
  style.width_pt = 1.8;
  return style;
}

Axes::Axes(cairo_t* context, const PanelBox& box, PlotAxis x, PlotAxis y)
    : context_(context), box_(box), x_(std::move(x)), y_(std::move(y)) {
  Widen(x_);
  Widen(y_);
  SelectFont(context_);
  DrawTicksX();
  DrawTicksY();
  DrawFrame();
}

double Axes::AtX(double x) const { return box_.x + box_.width * Share(x_, x); }
double Axes::AtY(double y) const { return box_.y + box_.height * (1.0 - Share(y_, y)); }

void Axes::DrawFrame() {
  cairo_set_source_rgb(context_, 0, 0, 0);
  cairo_set_line_width(context_, kLine_pt);
  cairo_rectangle(context_, box_.x, box_.y, box_.width, box_.height);
  cairo_stroke(context_);
  const double below = box_.y + box_.height + kTick_pt + 2.0 * kFont_pt + 2.0 * kGap_pt;
  Text(context_, box_.x + 0.5 * box_.width, below, x_.label, Anchor::kMiddle);
  cairo_save(context_);
  double widest = 0.0;  // of the names beside the axis, beyond which its label is
  for (const double tick : TicksOf(y_))
    widest = std::max(widest, TextWidth(context_, TickName(y_, tick)));
  cairo_translate(context_, box_.x - kTick_pt - 3.0 * kGap_pt - widest,
                  box_.y + 0.5 * box_.height);
  cairo_rotate(context_, -0.5 * std::numbers::pi);
  Text(context_, 0.0, 0.0, y_.label, Anchor::kMiddle);
  cairo_restore(context_);
}

void Axes::DrawTicksX() {
  const double bottom = box_.y + box_.height;
  double free_from = -1e9;  // names that would overlap are left out
  for (const double tick : TicksOf(x_)) {
    const double x = AtX(tick);
    cairo_set_line_width(context_, kLine_pt);
    cairo_set_source_rgb(context_, kGridGrey, kGridGrey, kGridGrey);
    cairo_move_to(context_, x, box_.y);
    cairo_line_to(context_, x, bottom);
    if (x_.categories.empty()) cairo_stroke(context_);
    cairo_new_path(context_);
    cairo_set_source_rgb(context_, 0, 0, 0);
    cairo_move_to(context_, x, bottom);
    cairo_line_to(context_, x, bottom + kTick_pt);
    cairo_stroke(context_);
    const std::string name = TickName(x_, tick);
    const double half = 0.5 * TextWidth(context_, name);
    if (x - half < free_from) continue;
    Text(context_, x, bottom + kTick_pt + kFont_pt + 1.0, name, Anchor::kMiddle);
    free_from = x + half + kGap_pt;
  }
}

void Axes::DrawTicksY() {
  for (const double tick : TicksOf(y_)) {
    const double y = AtY(tick);
    cairo_set_line_width(context_, kLine_pt);
    cairo_set_source_rgb(context_, kGridGrey, kGridGrey, kGridGrey);
    cairo_move_to(context_, box_.x, y);
    cairo_line_to(context_, box_.x + box_.width, y);
    cairo_stroke(context_);
    cairo_set_source_rgb(context_, 0, 0, 0);
    cairo_move_to(context_, box_.x - kTick_pt, y);
    cairo_line_to(context_, box_.x, y);
    cairo_stroke(context_);
    Text(context_, box_.x - kTick_pt - kGap_pt, y + 0.35 * kFont_pt, TickName(y_, tick),
         Anchor::kRight);
  }
}

void Axes::Select(const SeriesStyle& style) {
  cairo_set_source_rgb(context_, style.red, style.green, style.blue);
  cairo_set_line_width(context_, style.width_pt);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(context_, &style.dash_pt, style.dash_pt > 0.0 ? 1 : 0, 0.0);
}

void Axes::Line(const std::vector<PlotPoint>& points, const SeriesStyle& style) {
  cairo_save(context_);
  cairo_rectangle(context_, box_.x, box_.y, box_.width, box_.height);
  cairo_clip(context_);
  Select(style);
  bool joined = false;
  for (const PlotPoint& point : points) {
    const double x = AtX(point.x), y = AtY(point.y);
    const bool known = std::isfinite(x) && std::isfinite(y);
    if (known && joined) cairo_line_to(context_, x, y);
    if (known && !joined) cairo_move_to(context_, x, y);
    joined = known;
  }
  cairo_stroke(context_);
  cairo_restore(context_);
}

void Axes::Markers(const std::vector<PlotPoint>& points, const SeriesStyle& style) {
  cairo_save(context_);
  Select(style);
  for (const PlotPoint& point : points) {
    cairo_arc(context_, AtX(point.x), AtY(point.y), kMarker_pt, 0.0, 2.0 * std::numbers::pi);
    cairo_fill(context_);
  }
  cairo_restore(context_);
}

void Axes::Bar(double x_min, double x_max, double y, const SeriesStyle& style) {
  const double top = AtY(y), bottom = AtY(y_.min);
  cairo_set_source_rgba(context_, style.red, style.green, style.blue, kBarShade);
  cairo_rectangle(context_, AtX(x_min), top, AtX(x_max) - AtX(x_min), bottom - top);
  cairo_fill(context_);
}

void Axes::Whisker(double x, double y_min, double y_max, const SeriesStyle& style) {
  cairo_save(context_);
  Select(style);
  cairo_set_line_width(context_, kLine_pt);
  cairo_move_to(context_, AtX(x), AtY(y_min));
  cairo_line_to(context_, AtX(x), AtY(y_max));
  cairo_move_to(context_, AtX(x) - kTick_pt, AtY(y_max));
  cairo_line_to(context_, AtX(x) + kTick_pt, AtY(y_max));
  cairo_stroke(context_);
  cairo_restore(context_);
}

std::vector<double> RoundTicks(double min, double max) {
  const double raw = (max - min) / kTicks;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * decade;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * decade >= raw) step = factor * decade;
  }
  std::vector<double> ticks;
  const double first = std::ceil(min / step - kTickRoundOff);
  const double last = std::floor(max / step + kTickRoundOff);
  for (double k = first; k <= last; k += 1.0) ticks.push_back(k * step);
  return ticks;
}

double DrawLegend(cairo_t* context, double x, double y, double width,
                  const std::vector<LegendEntry>& entries) {
  return LayOutLegend(
      context, width, entries, [&](const LegendEntry& entry, double dx, double dy) {
        const SeriesStyle& style = entry.style;
        cairo_save(context);
        cairo_set_source_rgb(context, style.red, style.green, style.blue);
        cairo_set_line_width(context, style.width_pt + 0.6);
        cairo_set_dash(context, &style.dash_pt, style.dash_pt > 0.0 ? 1 : 0, 0);
        cairo_move_to(context, x + dx, y + dy - 0.35 * kFont_pt);
        cairo_rel_line_to(context, kLegendSample_pt, 0.0);
        cairo_stroke(context);
        cairo_restore(context);
        cairo_set_source_rgb(context, 0, 0, 0);
        Text(context, x + dx + kLegendSample_pt + kGap_pt, y + dy, entry.name, Anchor::kLeft);
      });
}

double LegendHeight(double width, const std::vector<LegendEntry>& entries) {
  // Widths of text need a surface; nothing is drawn on this one.
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                   &cairo_destroy);
  return LayOutLegend(context.get(), width, entries, [](const LegendEntry&, double, double) {});
}

}  // namespace eval
