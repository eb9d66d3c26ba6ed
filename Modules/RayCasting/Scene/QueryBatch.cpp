// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/QueryBatch.h"

#include "Kernels/QueryCounts.h"
#include "Simd/Prefetch.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// Memory that all batches of a thread reuse.
template <class Job>
std::vector<Job>& emptyJobs()
{
  static thread_local std::vector<Job> jobs;
  jobs.clear();
  return jobs;
}

}

Scene::QueryBatch::QueryBatch(const Scene& scene, const Ray* rays, Hit* best, const double* from)
  : scene_(scene)
  , rays_(rays)
  , best_(best)
  , from_(from)
  , jobs_(emptyJobs<Job>())
{
}

void Scene::QueryBatch::add(std::uint32_t ray, std::uint32_t object)
{
  jobs_.push_back({ ray, object, nullptr, nullptr, best_[ray].distance });
}

void Scene::QueryBatch::add(std::uint32_t ray, const MixedTree& mixed)
{
  jobs_.push_back({ ray, 0, &mixed, nullptr, best_[ray].distance });
}

void Scene::QueryBatch::add(
  const MixedTree& mixed, std::uint32_t first, std::uint32_t end, const Order& order)
{
  for (std::uint32_t place = first; place < end; ++place)
  {
    add(rayAt(order, place), mixed);
  }
}

void Scene::QueryBatch::runIfMany()
{
  if (jobs_.size() >= kMany)
  {
    run();
  }
}

void Scene::QueryBatch::addGroup(
  const Group& group, std::uint32_t first, std::uint32_t end, const Order& order, Order* alone)
{
  const std::size_t bodies = group.bodies.isEmpty() ? group.instanced.size() : 0;
  std::uint32_t rays[BallLanes::kSize];
  BallLanes lanes;
  for (std::uint32_t place = first; place < end; ++place)
  {
    rays[place - first] = rayAt(order, place);
    lanes.set(place - first, rays_[rays[place - first]]);
  }
  passing_.resize(bodies);
  for (std::size_t body = 0; body < bodies; ++body)
  {
    passing_[body] = passingOf(lanes, scene_.placed_[group.instanced[body]].ball);
  }
  for (unsigned lane = 0; lane < end - first; ++lane)
  {
    const std::uint32_t ray = rays[lane];
    const std::size_t before = jobs_.size();
    if (group.flattened)
    {
      add(ray, *group.flattened);
    }
    for (std::size_t body = 0; body < bodies; ++body)
    {
      if ((passing_[body] >> lane & 1) != 0)
      {
        enter(ray, group.instanced[body]);
      }
    }
    if (alone)
    {
      jobs_.size() > before ? add(ray, 0) : alone->push_back(ray);
    }
  }
}

void Scene::QueryBatch::run()
{
  end_ = static_cast<std::uint32_t>(jobs_.size());
  runQueries(*this);
  confirm();
  if (queryCounts())
  {
    queryCounts()->triangles += confirmed_;
  }
  confirmed_ = 0;
  jobs_.clear();
  next_ = 0;
}

void Scene::QueryBatch::runAll(std::uint32_t first, std::uint32_t end, const Order& order)
{
  isForAll_ = true;
  order_ = &order;
  next_ = first;
  end_ = end;
  runQueries(*this);
  isForAll_ = false;
  next_ = 0;
}

void Scene::QueryBatch::runAllStatic(std::uint32_t count, const Order& order)
{
  runAll(0, count, order);
  run();
}

void Scene::QueryBatch::runAllBodies(const Group& group, std::uint32_t count, const Order& order)
{
  for (std::uint32_t first = 0; first < count; first += kMany)
  {
    group_ = &group;
    runAll(first, std::min(first + kMany, count), order);
    group_ = nullptr;
    run();
  }
}

std::size_t Scene::QueryBatch::next(QueryRequest* requests, std::size_t most)
{
  const std::size_t count = std::min<std::size_t>(most, end_ - next_);
  for (std::size_t i = 0; i < count; ++i, ++next_)
  {
    bool isShared = false;
    if (isForAll_)
    {
      const std::uint32_t ray = rayAt(*order_, next_);
      request({ ray, 0, nullptr, nullptr, best_[ray].distance }, requests[i]);
    }
    else
    {
      const Job& job = jobs_[next_];
      isShared = (next_ > 0 && jobs_[next_ - 1].ray == job.ray) ||
        (next_ + 1 < end_ && jobs_[next_ + 1].ray == job.ray);
      request(job, requests[i]);
    }
    requests[i].job = next_;
    requests[i].isShared = isShared;
  }
  return count;
}

std::uint32_t Scene::QueryBatch::rayAt(const Order& order, std::size_t place) const
{
  constexpr std::size_t kAhead = 32;
  if (order.empty())
  {
    return static_cast<std::uint32_t>(place);
  }
  if (place + kAhead < order.size())
  {
    const std::uint32_t soon = order[place + kAhead];
    const auto* ray = reinterpret_cast<const char*>(rays_ + soon);
    prefetchLine(ray);
    prefetchLine(ray + sizeof(Ray) - 1);
    prefetchLine(best_ + soon);
  }
  return order[place];
}

void Scene::QueryBatch::request(const Job& job, QueryRequest& request) const
{
  const Ray& ray = rays_[job.ray];
  const LocalRay local = scene_.localRay(ray, job.object);
  request.origin = local.origin;
  request.direction = local.direction;
  request.from = from_ ? from_[job.ray] : 0.0;
  request.bound = job.bound;
  request.skipped = TriangleBlock::kNone;
  if (job.mixed)
  {
    request.tree = &job.mixed->tree;
    request.skipped = job.mixed->referenceTo(ray.start);
    return;
  }
  if (group_)
  {
    request.tree = &group_->bodies;
    return;
  }
  request.tree = &scene_.bodyOf(job.object).tree();
  if (ray.start.object == job.object)
  {
    request.skipped = ray.start.triangle;
  }
}

void Scene::QueryBatch::begin(TreeQuery& query)
{
  Job& job = jobs_[query.job];
  job.query = &query;
  query.setBound(job.bound);
}

void Scene::QueryBatch::finish(
  const TreeQuery& query, const std::uint32_t* references, std::size_t count)
{
  const Job job = jobOf(query.job);
  if (group_)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (std::find(references, references + i, references[i]) == references + i)
      {
        enter(job.ray, group_->instanced[references[i]]);
      }
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const TriangleId id = idOf(job, references[i]);
    scene_.bodyOf(id.object).mesh().prefetch(id.triangle);
    if (pendingCount_ == pendingHits_.size())
    {
      confirm();
    }
    pendingHits_[pendingCount_++] = { job.ray, id };
  }
}

void Scene::QueryBatch::enter(std::uint32_t ray, std::uint32_t index)
{
  if (scene_.mayTouch(scene_.placed_[index], rays_[ray], best_[ray].distance))
  {
    add(ray, index + 1);
  }
}

void Scene::QueryBatch::confirm()
{
  for (std::size_t first = 0; first < pendingCount_; first += IntersectionLanes::kSize)
  {
    const auto count = std::min<std::size_t>(pendingCount_ - first, IntersectionLanes::kSize);
    for (unsigned lane = 0; lane < count; ++lane)
    {
      const auto& [ray, id] = pendingHits_[first + lane];
      const LocalRay local = scene_.localRay(rays_[ray], id.object);
      lanes_.set(lane, local.origin, local.direction, scene_.localTriangle(id));
    }
    intersectAll(lanes_);
    for (unsigned lane = 0; lane < count; ++lane)
    {
      if (lanes_.distance[lane] > 0)
      {
        take(pendingHits_[first + lane], lanes_.distance[lane], lanes_.weightB[lane],
          lanes_.weightC[lane]);
      }
    }
  }
  confirmed_ += pendingCount_;
  pendingCount_ = 0;
}

void Scene::QueryBatch::take(
  const PendingHit& pending, double distance, double weightB, double weightC)
{
  const Hit hit{ distance, pending.id,
    { static_cast<float>(weightB), static_cast<float>(weightC) } };
  Hit& best = best_[pending.ray];
  if (isCloser(hit, best))
  {
    best = hit;
  }
}

void Scene::QueryBatch::test(TreeQuery& query, std::uint32_t reference)
{
  const Job job = jobOf(query.job);
  if (group_)
  {
    enter(job.ray, group_->instanced[reference]);
    return;
  }
  const TriangleId id = idOf(job, reference);
  Vector3 weights;
  double found;
  ++confirmed_;
  if (scene_.intersects(rays_[job.ray], id, found, &weights))
  {
    take({ job.ray, id }, found, weights[1], weights[2]);
  }
  const double distance = best_[job.ray].distance;
  if (distance < query.bound())
  {
    query.setBound(distance);
    if (query.isShared)
    {
      narrow(query);
    }
  }
}

/// The ray's other searches need not look farther either.
void Scene::QueryBatch::narrow(const TreeQuery& query)
{
  const double bound = query.bound();
  const std::uint32_t ray = jobs_[query.job].ray;
  const auto shorten = [&](Job& other, std::uint32_t place) {
    if (bound < other.bound)
    {
      other.bound = bound;
      if (other.query && other.query->job == place)
      {
        other.query->setBound(bound);
      }
    }
  };
  for (std::uint32_t i = query.job; i > 0 && jobs_[i - 1].ray == ray; --i)
  {
    shorten(jobs_[i - 1], i - 1);
  }
  for (std::uint32_t i = query.job + 1; i < jobs_.size() && jobs_[i].ray == ray; ++i)
  {
    shorten(jobs_[i], i);
  }
}

}
