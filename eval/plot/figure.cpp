#include "eval/plot/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace eval {
namespace {

constexpr double kPixelsPerPoint = 200.0 / 72.0;  // dots an inch: sharp on screen and in print

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t Append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void Require(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(std::string("a plot cannot be drawn: ") +
                           cairo_status_to_string(status));
}

void DrawOn(cairo_surface_t* surface, double scale, const std::function<void(cairo_t*)>& draw) {
  const Context context(cairo_create(surface), &cairo_destroy);
  cairo_scale(context.get(), scale, scale);
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  draw(context.get());
  Require(cairo_status(context.get()));
}

/// A surface that writes as it is drawn on is whole once it is finished.
void Finish(cairo_surface_t* surface) {
  cairo_surface_finish(surface);
  Require(cairo_surface_status(surface));
}

/// Cairo numbers the surfaces of a process, and names the drawing by that number; nothing refers to
/// it.
void DropSurfaceNumber(std::string& svg) {
  const std::string name = "<g id=\"surface";
  const std::size_t number = svg.find(name);
  if (number == std::string::npos) return;
  const std::size_t from = number + name.size();
  svg.erase(from, svg.find('"', from) - from);
}

std::string SvgBytes(const FigureSize& size, const std::function<void(cairo_t*)>& draw) {
  std::string bytes;
  const Surface surface(
      cairo_svg_surface_create_for_stream(&Append, &bytes, size.width_pt, size.height_pt),
      &cairo_surface_destroy);
  DrawOn(surface.get(), 1.0, draw);
  Finish(surface.get());
  DropSurfaceNumber(bytes);
  return bytes;
}

std::string PdfBytes(const FigureSize& size, const std::function<void(cairo_t*)>& draw) {
  std::string bytes;
  const Surface surface(
      cairo_pdf_surface_create_for_stream(&Append, &bytes, size.width_pt, size.height_pt),
      &cairo_surface_destroy);
  // Cairo would write the time of the drawing.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");
  DrawOn(surface.get(), 1.0, draw);
  Finish(surface.get());
  return bytes;
}

std::string PngBytes(const FigureSize& size, const std::function<void(cairo_t*)>& draw) {
  const auto pixels = [](double points) {
    return static_cast<int>(std::lround(points * kPixelsPerPoint));
  };
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(size.width_pt),
                                                   pixels(size.height_pt)),
                        &cairo_surface_destroy);
  DrawOn(surface.get(), kPixelsPerPoint, draw);
  std::string bytes;
  Require(cairo_surface_write_to_png_stream(surface.get(), &Append, &bytes));
  return bytes;
}

}  // namespace

std::vector<PlotFile> RenderFigure(const std::string& name, const FigureSize& size,
                                   const std::function<void(cairo_t*)>& draw) {
  return {{name + ".svg", SvgBytes(size, draw)},
          {name + ".pdf", PdfBytes(size, draw)},
          {name + ".png", PngBytes(size, draw)}};
}

}  // namespace eval
