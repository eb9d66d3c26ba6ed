// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/PointDirectLight.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace irradiance
{

/// A segment of a path, from one hit to the next.
struct PathSegment
{
  std::array<float, 3> from;
  std::array<float, 3> to; ///< where it hits; where it hits nothing, its direction
  std::uint32_t triangle;  ///< the number of what it hits, or SceneTriangles::kNone
  bool isFront : 1;        ///< which side it hits
  bool isSpecular : 1;     ///< it left a start sharply, and since then only clear sheets
  bool isStraight : 1;     ///< it left its start straight through a clear sheet
  bool isKnown : 1;        ///< what the side received is read
  bool isDirectKnown : 1;  ///< what it received straight from the lights is read
  bool asksLights : 1;     ///< the lights were asked for what is not read
  bool hasLampWeight : 1;  ///< it leads to a lamp, which was also asked
  bool touchesMover : 1; ///< its start or its hit, which is there or not depending on what is solid
};

/**
 * Paths of a final gather as they were followed, one behind the other: segments, the numbers that
 * belong to these, and the rays of lights that were asked where they end. What they bring is no
 * part of it: PathSums reads that from the sums of a frame.
 */
class FollowedPaths
{
public:
  /// A path's part.
  struct Path
  {
    const PathSegment* begin;
    const PathSegment* end;
    const double* values;
    const ShadowRay* shadows;
    const ShadowRay* endOfShadows;
  };

  std::size_t size() const { return ends_.size(); }
  std::size_t numberOfSegments() const { return segments_.size(); }
  Path operator[](std::size_t path) const
  {
    const End first = startOf(path);
    const End& end = ends_[path];
    return { segments_.data() + first.segment, segments_.data() + end.segment,
      values_.data() + first.value, shadows_.data() + first.shadow, shadows_.data() + end.shadow };
  }
  /// Forgets all paths, and makes room for others.
  void clear(std::size_t paths, std::size_t segments, std::size_t values)
  {
    segments_.clear();
    segments_.reserve(segments);
    values_.clear();
    values_.reserve(values);
    shadows_.clear();
    ends_.clear();
    ends_.reserve(paths);
  }
  /// To the path that endPath() ends. `values`: with several bands the weights of the segment; what
  /// the lights brought where they were asked; the weight of a lamp. `shadows`: of these lights.
  void addSegment(const PathSegment& segment, const double* values, const double* endOfValues,
    const ShadowRay* shadows, const ShadowRay* endOfShadows)
  {
    segments_.push_back(segment);
    values_.insert(values_.end(), values, endOfValues);
    shadows_.insert(shadows_.end(), shadows, endOfShadows);
  }
  void endPath() { ends_.push_back({ segments_.size(), values_.size(), shadows_.size() }); }
  static constexpr std::size_t kAnew = std::numeric_limits<std::size_t>::max();
  /// These, in order, and among them some that were followed before: for each of all, its place
  /// there, or kAnew. Runs of paths that follow each other are taken together.
  FollowedPaths mergedWith(
    const FollowedPaths& before, const std::vector<std::size_t>& places) const
  {
    FollowedPaths merged;
    merged.ends_.reserve(places.size());
    merged.segments_.reserve(before.segments_.size());
    std::size_t next = 0; // of these
    for (std::size_t i = 0; i < places.size();)
    {
      const bool isAnew = places[i] == kAnew;
      const std::size_t first = isAnew ? next : places[i];
      std::size_t count = 1;
      while (i + count < places.size() && places[i + count] == (isAnew ? kAnew : first + count))
      {
        ++count;
      }
      merged.addPaths(isAnew ? *this : before, first, first + count);
      next += isAnew ? count : 0;
      i += count;
    }
    return merged;
  }
  /// Of its memory.
  std::size_t bytes() const
  {
    return segments_.capacity() * sizeof(PathSegment) + values_.capacity() * sizeof(double) +
      shadows_.capacity() * sizeof(ShadowRay) + ends_.capacity() * sizeof(End);
  }

private:
  /// Adds paths [first, end) of others.
  void addPaths(const FollowedPaths& from, std::size_t first, std::size_t end)
  {
    const End begin = from.startOf(first), last = from.startOf(end);
    const End shift{ segments_.size() - begin.segment, values_.size() - begin.value,
      shadows_.size() - begin.shadow }; // modulo 2^64
    segments_.insert(
      segments_.end(), from.segments_.data() + begin.segment, from.segments_.data() + last.segment);
    values_.insert(
      values_.end(), from.values_.data() + begin.value, from.values_.data() + last.value);
    shadows_.insert(
      shadows_.end(), from.shadows_.data() + begin.shadow, from.shadows_.data() + last.shadow);
    for (std::size_t path = first; path < end; ++path)
    {
      const End& own = from.ends_[path];
      ends_.push_back(
        { own.segment + shift.segment, own.value + shift.value, own.shadow + shift.shadow });
    }
  }
  struct End
  {
    std::size_t segment, value, shadow;
  };
  /// Of the paths before.
  End startOf(std::size_t path) const { return path == 0 ? End{ 0, 0, 0 } : ends_[path - 1]; }

  std::vector<PathSegment> segments_;
  std::vector<double> values_;
  std::vector<ShadowRay> shadows_;
  std::vector<End> ends_;
};

}
