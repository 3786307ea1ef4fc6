#pragma once
// Fields that have one value almost everywhere. Pages of sites whose values all are that one are not stored.
#include <array>
#include <memory>
#include <vector>

#include "grid/layout.h"

namespace seiche {

// Concurrent reads are safe, writes are not: a write may make a page.
template <class T>
class PagedValues {
 public:
  PagedValues() = default;
  PagedValues(std::size_t size, T everywhere) : pages_((size + page - 1) / page), everywhere_(everywhere) {}
  PagedValues(PagedValues&&) noexcept = default;
  PagedValues& operator=(PagedValues&&) noexcept = default;
  PagedValues(const PagedValues& other) : pages_(other.pages_.size()), everywhere_(other.everywhere_) {
    for (std::size_t n = 0; n < pages_.size(); ++n)
      if (other.pages_[n]) pages_[n] = std::make_unique<Page>(*other.pages_[n]);
  }
  PagedValues& operator=(const PagedValues& other) { return *this = PagedValues(other); }

  T operator[](Site s) const {
    const auto& values = pages_[std::size_t(s) / page];
    return values ? (*values)[std::size_t(s) % page] : everywhere_;
  }
  void set(Site s, T value) {
    auto& values = pages_[std::size_t(s) / page];
    if (!values) {
      if (value == everywhere_) return;
      values = std::make_unique<Page>();
      values->fill(everywhere_);
    }
    (*values)[std::size_t(s) % page] = value;
  }
  void add(Site s, T value) { set(s, (*this)[s] + value); }
  void fill(T value) { *this = PagedValues(pages_.size() * page, value); }
  // Calls body(site, value) in order, on all sites of the stored pages: all that have another value, and some more.
  template <class Body>
  void for_each_stored(const Body& body) const {
    for (std::size_t n = 0; n < pages_.size(); ++n)
      for (std::size_t k = 0; pages_[n] && k < page; ++k) body(Site(n * page + k), (*pages_[n])[k]);
  }

 private:
  static constexpr std::size_t page = 64;  // sites
  using Page = std::array<T, page>;

  std::vector<std::unique_ptr<Page>> pages_;
  T everywhere_{};
};

template <int Dim, class T = double>
class PagedCellField : public PagedValues<T> {
 public:
  PagedCellField() = default;
  explicit PagedCellField(const Layout<Dim>& layout, T value = T{})
      : PagedValues<T>(std::size_t(layout.size()), value) {}
};

// One component per axis, as in FaceField.
template <int Dim, class T = double>
class PagedFaceField {
 public:
  PagedFaceField() = default;
  explicit PagedFaceField(const Layout<Dim>& layout, T value = T{}) {
    for (auto& c : components_) c = PagedValues<T>(std::size_t(layout.size()), value);
  }
  PagedValues<T>& operator[](int axis) { return components_[axis]; }
  const PagedValues<T>& operator[](int axis) const { return components_[axis]; }
  T at(int axis, Site s) const { return components_[axis][s]; }
  void set(int axis, Site s, T value) { components_[axis].set(s, value); }
  void add(int axis, Site s, T value) { components_[axis].add(s, value); }
  void fill(T value) {
    for (auto& c : components_) c.fill(value);
  }

 private:
  std::array<PagedValues<T>, Dim> components_;
};

}  // namespace seiche
