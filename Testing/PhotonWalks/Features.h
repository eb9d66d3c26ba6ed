// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Kit.h"

namespace irradiance::test
{

/// A frame, and how it is computed.
struct FilmFrame
{
  SceneObjects objects;
  EngineSettings settings;
};
using Film = std::vector<FilmFrame>;

struct Asking
{
  Execution& execution;
  double unit = 1;          ///< of lengths, in m
  bool withRepairs = false; ///< also what a fresh engine does not know
};

/// What is asked of an engine in a frame beside its cells. It may keep something from frame to
/// frame.
using View =
  std::function<void(const std::shared_ptr<IrradianceEngine>& engine, const Asking&, Answer&)>;

/// A row of the table of laws: each law holds for each feature.
struct Feature
{
  const char* name;
  std::function<Film()> film;
  std::function<View()> view = {};
  /// Whether later frames may shoot walks as well.
  bool shootsLater = false;
  /// Whether its light is too faint for walks.
  bool hasNoWalks = false;
  friend std::ostream& operator<<(std::ostream& out, const Feature& feature)
  {
    return out << feature.name;
  }
};

std::vector<Feature> features();

/// An engine that goes through the film of a feature.
class FilmRun
{
public:
  explicit FilmRun(const Feature& feature)
    : view_(feature.view ? feature.view() : View())
  {
  }
  void update(const FilmFrame& frame, Execution& execution)
  {
    engine_->update(frame.objects, frame.settings, execution);
  }
  /// All that the engine says of the last frame.
  Answer told(const Asking& asking) const;
  Answer at(const FilmFrame& frame, Execution& execution)
  {
    update(frame, execution);
    return told({ execution });
  }
  const IrradianceEngine& engine() const { return *engine_; }

private:
  std::shared_ptr<IrradianceEngine> engine_ = std::make_shared<IrradianceEngine>();
  View view_;
};

/// By a new engine that is serial.
inline Answer freshAnswer(const Feature& feature, const FilmFrame& frame)
{
  Execution serial;
  return FilmRun(feature).at(frame, serial);
}

/// The film in another unit of length: of its dynamic objects either the models or their poses are
/// scaled.
Film scaledFilm(const Film& film, double scale, bool scalesModels);

}
