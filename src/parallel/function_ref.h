#pragma once
// A parameter for something that can be called. It refers to that, as a pointer does, and so takes
// neither memory nor the header <functional>.

#include <type_traits>

namespace hemilux {

template <class Signature>
class FunctionRef;

/// Refers to a function object for as long as a call of whoever takes it as a parameter lasts.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <class Function>
    requires(!std::is_same_v<Function, FunctionRef>) FunctionRef(
        const Function& function) // NOLINT(google-explicit-constructor): a lambda is passed
        : function_(&function), call_([](const void* of, Arguments... arguments) -> Result {
              return Result((*static_cast<const Function*>(of))(arguments...));
          }) {}

    Result operator()(Arguments... arguments) const { return call_(function_, arguments...); }

  private:
    const void* function_;
    Result (*call_)(const void* of, Arguments... arguments);
};

} // namespace hemilux
