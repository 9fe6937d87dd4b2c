// Any bytes either are a sensor, each of whose parameters lies within its stated range, or are
// refused with the one typed error that tells where.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "io/input_error.h"
#include "sim/sensor/read_sensor.h"

namespace {

void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz_sensor: %s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const sim::Sensor sensor = sim::ParseSensor(text, "fuzz.yaml");
    for (const sim::SensorParameter& parameter : sim::Parameters(sensor)) {
      const double slack = 1e-9 * (1 + parameter.high);
      Require(
          parameter.value >= parameter.low - slack && parameter.value <= parameter.high + slack,
          "a parameter is outside its range");
    }
  } catch (const io::InputError& error) {
    Require(std::string(error.what()).starts_with("fuzz.yaml"),
            "an error does not say in which file");
  }
  return 0;
}
