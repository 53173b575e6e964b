#pragma once
// CLI11 is slow to compile: who only passes its parts on needs no more than their names.

namespace CLI {
class App;
class Option;
} // namespace CLI
