#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "components/geometry/box.hpp"
#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// A region that a body fills at set-up, by value: a box, a body of revolution, a difference of others ... A shape is
/// any type with
///
///     bool contains(const Vector<D>& x) const;
///     double reach(const Vector<D>& direction) const;  // the greatest x . direction [m] of its points, or a bound
///     void faces(const Vector<D>& x, SurfacePoints<D>& points) const;  // adds the point of each face nearest to x
///     Volume volume() const;
///     void check() const;                              // if it has one: throws BadValue for what is no shape
///     std::size_t n_shapes() const;                    // if it is made of others: how many they are in the end
///
/// Solids share their shapes, which do not change. Lengths in m.
template <int D>
class Solid
{
 public:
  /// Throws what the shape's check throws.
  template <class Shape>
  explicit Solid(Shape shape)
  {
    if constexpr (requires { shape.check(); }) shape.check();
    if constexpr (requires { shape.n_shapes(); }) {
      n_shapes_ = shape.n_shapes();
      is_made_of_others_ = true;
    }
    shape_ = std::make_shared<const Held<Shape>>(std::move(shape));
    const Box<D> box = bounding_box();
    middle_ = 0.5 * (box.lower + box.upper);
  }

  bool contains(const Vector<D>& x) const { return shape_->contains(x); }
  double reach(const Vector<D>& direction) const { return shape_->reach(direction); }
  void faces(const Vector<D>& x, SurfacePoints<D>& points) const { shape_->faces(x, points); }

  /// The distance of `x` from the surface. Of the shapes of set operations it is exact where the nearest point lies on
  /// a face of one of them; next to an edge in which two of them meet it may be off to either side.
  SignedDistance<D> distance(const Vector<D>& x) const;

  /// Volume [m^3]; in the plane the area [m^2], the volume of one metre of thickness.
  Volume volume() const { return shape_->volume(); }

  /// The shape itself if it is of this type, or null.
  template <class Shape>
  const Shape* get_if() const
  {
    const auto* held = dynamic_cast<const Held<Shape>*>(shape_.get());
    return held == nullptr ? nullptr : &held->shape;
  }

  /// Simple shapes that a question to the solid may have to ask.
  std::size_t n_shapes() const { return n_shapes_; }

  /// An axis-aligned box around the solid, as small as the shapes' reaches are exact.
  Box<D> bounding_box() const
  {
    Box<D> box;
    for (int k = 0; k < D; ++k) {
      box.lower[k] = -reach(-Vector<D>::Unit(k));
      box.upper[k] = reach(Vector<D>::Unit(k));
    }
    return box;
  }

 private:
  struct AnyShape {
    AnyShape() = default;
    AnyShape(const AnyShape&) = delete;
    AnyShape& operator=(const AnyShape&) = delete;
    virtual ~AnyShape() = default;
    virtual bool contains(const Vector<D>& x) const = 0;
    virtual double reach(const Vector<D>& direction) const = 0;
    virtual void faces(const Vector<D>& x, SurfacePoints<D>& points) const = 0;
    virtual Volume volume() const = 0;
  };

  template <class Shape>
  struct Held : AnyShape {
    explicit Held(Shape s) : shape(std::move(s)) {}
    bool contains(const Vector<D>& x) const override { return shape.contains(x); }
    double reach(const Vector<D>& direction) const override { return shape.reach(direction); }
    void faces(const Vector<D>& x, SurfacePoints<D>& points) const override { shape.faces(x, points); }
    Volume volume() const override { return shape.volume(); }
    Shape shape;
  };

  std::shared_ptr<const AnyShape> shape_;
  std::size_t n_shapes_ = 1;
  bool is_made_of_others_ = false;
  /// The middle of the bounding box [m].
  Vector<D> middle_;
};

}  // namespace tamp::components
