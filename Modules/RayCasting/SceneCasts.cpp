#include "SceneCasts.h"

namespace irradiance
{

namespace
{

/// Memory that serves all batches of a thread.
template <class Job>
std::vector<Job>& emptyJobs()
{
  static thread_local std::vector<Job> jobs;
  jobs.clear();
  return jobs;
}

}

Scene::Casts::Casts(const Scene& scene, const Ray* rays, Hit* best, const double* from)
  : scene_(scene)
  , rays_(rays)
  , best_(best)
  , from_(from)
  , jobs_(emptyJobs<Job>())
{
}

void Scene::Casts::add(std::uint32_t ray, std::uint32_t object)
{
  jobs_.push_back({ ray, object, nullptr, nullptr });
}

void Scene::Casts::add(std::uint32_t ray, const MixedTree& mixed)
{
  jobs_.push_back({ ray, 0, &mixed, nullptr });
}

void Scene::Casts::addGroup(std::uint32_t ray, const Group& group)
{
  if (!group.loose.tree.isEmpty())
  {
    add(ray, group.loose);
  }
  if (group.boxes.isEmpty() && !group.whole.empty())
  {
    const double reach = scene_.reachOf(rays_[ray]);
    for (const std::uint32_t index : group.whole)
    {
      if (scene_.mayTouch(scene_.placed_[index], rays_[ray], reach, best_[ray].distance))
      {
        add(ray, index + 1);
      }
    }
  }
}

void Scene::Casts::run()
{
  runCasts(*this);
}

bool Scene::Casts::next(UnitCast& cast)
{
  while (next_ < jobs_.size())
  {
    Job& job = jobs_[next_];
    cast.job = next_++;
    if (prepare(job, cast))
    {
      job.cast = &cast;
      cast.shearedObject = TriangleId::kNone;
      return true;
    }
  }
  cast.job = UnitCast::kNoJob;
  return false;
}

bool Scene::Casts::prepare(const Job& job, UnitCast& cast) const
{
  const Ray& ray = rays_[job.ray];
  const double from = from_ ? from_[job.ray] : 0.0, bound = best_[job.ray].distance;
  if (job.mixed || job.object == 0)
  {
    const TriangleTree& tree = job.mixed ? job.mixed->tree : scene_.static_->tree();
    return cast.prepare(tree, ray.origin, ray.direction, from, bound);
  }
  const Placed& placed = scene_.placed_[job.object - 1];
  return cast.prepare(placed.object.body->tree(), placed.toObject(ray.origin),
    placed.inverse * ray.direction, from, bound);
}

void Scene::Casts::test(UnitCast& cast, std::uint32_t reference)
{
  const Job& job = jobs_[cast.job];
  const TriangleId id =
    job.mixed ? job.mixed->ids[reference] : TriangleId{ job.object, reference };
  const Ray& ray = rays_[job.ray];
  if (id == ray.start)
  {
    return;
  }
  if (id.object != cast.shearedObject)
  {
    cast.shearedObject = id.object;
    cast.sheared = scene_.shearedFor(ray, id.object);
  }
  Hit hit;
  hit.id = id;
  Vector3 weights;
  if (cast.sheared.meets(scene_.bodyOf(id.object).mesh()[id.triangle], hit.distance, &weights) &&
    isCloser(hit, best_[job.ray]))
  {
    hit.weights = { static_cast<float>(weights[1]), static_cast<float>(weights[2]) };
    best_[job.ray] = hit;
    cast.setBound(hit.distance);
    shorten(cast.job - 1, job.ray);
    shorten(cast.job + 1, job.ray);
  }
}

/// If the job is for the same ray and runs at this moment, it need not go farther either.
void Scene::Casts::shorten(std::uint32_t job, std::uint32_t ray) const
{
  if (job < jobs_.size() && jobs_[job].ray == ray && jobs_[job].cast &&
    jobs_[job].cast->job == job)
  {
    jobs_[job].cast->setBound(best_[ray].distance);
  }
}

}
