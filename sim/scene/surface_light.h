#pragma once

#include "sim/scene/scene.h"

namespace sim {

/// Share of infrared light that a face scatters all round, [0, 1]: as the material says; else the
/// luminance of its base colour (ink is taken to be clear in the near infrared), of a screen
/// 0.003.
double InfraredOf(const Material& material);

/// Share of a face that mirrors as glass does, [0, 1]: as the material says; else 1 of a screen,
/// 0.3 of a cover and 0 of all others.
double GlossOf(const Material& material);

/// Share of light that glass reflects at an incidence. Source: Schlick 1994, n = 1.5.
double GlassReflection(double cosine);

}  // namespace sim
