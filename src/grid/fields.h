#pragma once
// Fields whose type states the location of their values. All fields of a rank have the shape of its Layout.
#include <array>

#include "grid/field_values.h"
#include "grid/layout.h"

namespace seiche {

namespace location {
struct Cell {};
struct Node {};
}  // namespace location

template <class T, int Dim, class Location>
class Field {
 public:
  Field() = default;
  explicit Field(const Layout<Dim>& layout, T value = T{}) : data_(std::size_t(layout.size()), value) {}
  T& operator[](Site s) { return data_[std::size_t(s)]; }
  const T& operator[](Site s) const { return data_[std::size_t(s)]; }
  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }
  void fill(T value) { data_.fill(value); }
  bool empty() const { return data_.empty(); }

 private:
  FieldValues<T> data_;
};

template <int Dim, class T = double>
using CellField = Field<T, Dim, location::Cell>;
template <int Dim, class T = double>
using NodeField = Field<T, Dim, location::Node>;

// One component per axis, on the low face of each cell across that axis.
template <int Dim, class T = double>
class FaceField {
 public:
  FaceField() = default;
  explicit FaceField(const Layout<Dim>& layout, T value = T{}) {
    for (auto& c : components_) c.assign(std::size_t(layout.size()), value);
  }
  FieldValues<T>& operator[](int axis) { return components_[axis]; }
  const FieldValues<T>& operator[](int axis) const { return components_[axis]; }
  T& at(int axis, Site s) { return components_[axis][std::size_t(s)]; }
  const T& at(int axis, Site s) const { return components_[axis][std::size_t(s)]; }
  void fill(T value) {
    for (auto& c : components_) c.fill(value);
  }

 private:
  std::array<FieldValues<T>, Dim> components_;
};

// One component per plane of rotation, on the low edge of each cell. In 3D component c is on edges along axis c; in 2D
// the only one is on nodes.
template <int Dim, class T = double>
class EdgeField {
 public:
  static constexpr int count = Dim == 3 ? 3 : 1;
  EdgeField() = default;
  explicit EdgeField(const Layout<Dim>& layout, T value = T{}) {
    for (auto& c : components_) c.assign(std::size_t(layout.size()), value);
  }
  FieldValues<T>& operator[](int edge) { return components_[edge]; }
  const FieldValues<T>& operator[](int edge) const { return components_[edge]; }

 private:
  std::array<FieldValues<T>, count> components_;
};

}  // namespace seiche
