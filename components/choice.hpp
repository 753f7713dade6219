#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "components/alternatives.hpp"

namespace tamp::components
{

/// A word of scenes, the value that it stands for, and its meaning: half a line for people, in Markdown.
template <class Value>
struct Word {
  std::string_view word;
  Value value;
  std::string_view meaning{};
  /// The word of earlier versions, where that is still read.
  std::string_view old_word{};
};

/// A choice among the alternatives of a variant, each of which has a `word`, its name in scenes, a `meaning`, and where
/// it was renamed an `old_word`.
template <class Alternatives>
class Choice
{
 public:
  /// Chooses by word, `Choice("flip")`; an unknown word does not compile.
  consteval Choice(const char* word) : number_(number_of(word)) {}
  /// Chooses by the index among the alternatives.
  explicit constexpr Choice(int number) : number_(number) {}
  explicit constexpr operator int() const { return number_; }

  friend constexpr bool operator==(Choice, Choice) = default;

  /// The words of all alternatives.
  static std::vector<Word<Choice>> words()
  {
    std::vector<Word<Choice>> all;
    for_each_alternative<Alternatives>([&]<class T>(std::type_identity<T>) {
      all.push_back({T::word, Choice(static_cast<int>(all.size())), T::meaning});
      if constexpr (requires { T::old_word; }) all.back().old_word = T::old_word;
    });
    return all;
  }

  std::string_view word() const
  {
    return visit([]<class T>(std::type_identity<T>) -> std::string_view { return T::word; });
  }

  /// Calls `visit(std::type_identity<T>())` with the type that is chosen.
  template <class Visit>
  auto visit(Visit&& visit) const
  {
    return with_alternative<Alternatives>(static_cast<std::size_t>(number_), visit);
  }

 private:
  static consteval int number_of(std::string_view word)
  {
    int n = 0, found = -1;
    for_each_alternative<Alternatives>([&]<class T>(std::type_identity<T>) {
      if (T::word == word) found = n;
      ++n;
    });
    if (found < 0) throw "no such word";
    return found;
  }

  int number_;
};

}  // namespace tamp::components
