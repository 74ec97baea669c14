// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace meniscus::test
{

/** The whole numbers from the first one to the one before `end`. */
template <typename T>
class Numbers
{
public:
  constexpr Numbers(T first, T end)
    : First(first)
    , End(end)
  {
  }
  constexpr std::size_t size() const
  {
    return this->First < this->End ? static_cast<std::size_t>(this->End - this->First) : 0;
  }
  constexpr T operator[](std::size_t i) const { return static_cast<T>(this->First + T(i)); }

private:
  T First;
  T End;
};

/** The numbers below `end`, of a type of one's choice. */
template <typename T, typename End>
constexpr Numbers<T> Below(End end)
{
  return { T(0), static_cast<T>(end) };
}

/** All combinations of the elements of lists; see Product(). */
template <typename... Lists>
class ProductOf
{
public:
  explicit ProductOf(Lists... lists)
    : Parts(std::move(lists)...)
  {
  }

  class Iterator
  {
  public:
    Iterator(const ProductOf* product, std::size_t place)
      : Product(product)
      , Place(place)
    {
    }
    auto operator*() const
    {
      return this->Product->At(this->Place, std::index_sequence_for<Lists...>());
    }
    Iterator& operator++()
    {
      ++this->Place;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return this->Place != other.Place; }

  private:
    const ProductOf* Product;
    std::size_t Place;
  };

  Iterator begin() const { return { this, 0 }; }
  Iterator end() const
  {
    return { this,
      std::apply([](const auto&... parts) { return (parts.size() * ...); }, this->Parts) };
  }

private:
  template <typename Values>
  using Element = std::decay_t<decltype(std::declval<const Values&>()[0])>;

  template <std::size_t... Is>
  std::tuple<Element<Lists>...> At(std::size_t place, std::index_sequence<Is...>) const
  {
    // The last list is the fastest.
    std::size_t index[] = { std::get<Is>(this->Parts).size()... };
    for (std::size_t i = sizeof...(Is); i-- > 0;)
    {
      const std::size_t size = index[i];
      index[i] = place % size;
      place /= size;
    }
    return { std::get<Is>(this->Parts)[index[Is]]... };
  }

  std::tuple<Lists...> Parts;
};

/** A list of values, which may have several arithmetic types. */
template <typename... Values>
std::vector<std::common_type_t<Values...>> List(Values... values)
{
  return { static_cast<std::common_type_t<Values...>>(values)... };
}

/** A number n stands for 0 to n - 1; lists are copied. */
template <typename Values>
auto ToList(const Values& values)
{
  if constexpr (std::is_integral_v<Values>)
  {
    return Numbers<Values>(0, values);
  }
  else
  {
    return values;
  }
}

/**
 * Nested loops in one: `for (const auto& [y, x] : Product(height, List(1, 3)))` visits all
 * combinations; the last element changes fastest.
 */
template <typename... Lists>
auto Product(const Lists&... lists)
{
  return ProductOf<decltype(ToList(lists))...>(ToList(lists)...);
}

} // namespace meniscus::test
