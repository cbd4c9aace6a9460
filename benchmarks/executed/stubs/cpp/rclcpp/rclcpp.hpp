#pragma once
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>
namespace rclcpp {
struct Publisher {};
inline std::vector<int> & lines() { static std::vector<int> all; return all; }
struct Called {
  explicit Called(int line) { lines().push_back(line); }
  ~Called() { lines().pop_back(); }
};
class Node {
 public:
  explicit Node(const std::string &) {}
  virtual ~Node() = default;
  template <class T>
  std::shared_ptr<Publisher> create_publisher(
      const std::string & name, int, const char * file = __builtin_FILE(), int line = __builtin_LINE()) {
    std::string path(file);
    std::cout << path.substr(path.rfind('/') + 1) << '\t';
    for (int called : lines()) { std::cout << called << ','; }
    std::cout << line << '\t' << name << '\n';
    return nullptr;
  }
};
}
