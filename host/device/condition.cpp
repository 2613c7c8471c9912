#include "device/condition.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace phlux::device {

Macros::Macros() {
  undefine("__cplusplus"); // headers that the host shares
  define_opaque("__OPENCL_VERSION__");
  define_opaque("__OPENCL_C_VERSION__");
}

void Macros::define(const std::string& name, const std::string& value) {
  macros_[name] = {true, value};
}
void Macros::define_opaque(const std::string& name) {
  macros_[name] = {true, std::nullopt};
}
void Macros::undefine(const std::string& name) {
  macros_[name] = {false, std::nullopt};
}
void Macros::forget(const std::string& name) {
  macros_[name] = {std::nullopt, std::nullopt};
}

std::optional<bool> Macros::defined(const std::string& name) const {
  if (const auto macro = macros_.find(name); macro != macros_.end()) return macro->second.defined;
  for (const std::string_view reserved : {"_", "cl_", "CL_", "FP_"})
    if (name.rfind(reserved, 0) == 0) return std::nullopt;
  return false;
}

std::optional<std::string> Macros::value(const std::string& name) const {
  const auto macro = macros_.find(name);
  return macro == macros_.end() ? std::nullopt : macro->second.value;
}

namespace {

using Value = std::optional<std::int64_t>; // nothing: unknown

struct Unreadable {}; // an expression that is not understood

constexpr int deepest_macro = 32;

bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::vector<std::string> tokens_of(const std::string& text) {
  static constexpr std::array<std::string_view, 8> pairs{"&&", "||", "==", "!=", "<=", ">=", "<<", ">>"};
  std::vector<std::string> tokens;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
      ++at;
      continue;
    }
    if (continues_name(text[at])) {
      while (at + length < text.size() && continues_name(text[at + length])) ++length;
    } else {
      for (const auto pair : pairs)
        if (text.compare(at, 2, pair) == 0) length = 2;
    }
    tokens.push_back(text.substr(at, length));
    at += length;
  }
  return tokens;
}

int precedence(const std::string& op) {
  static const std::map<std::string, int> levels{
      {"||", 1}, {"&&", 2}, {"|", 3},  {"^", 4},  {"&", 5}, {"==", 6}, {"!=", 6}, {"<", 7},  {">", 7},
      {"<=", 7}, {">=", 7}, {"<<", 8}, {">>", 8}, {"+", 9}, {"-", 9},  {"*", 10}, {"/", 10}, {"%", 10}};
  const auto level = levels.find(op);
  return level == levels.end() ? 0 : level->second;
}

std::int64_t arithmetic(const std::string& op, std::int64_t a, std::int64_t b) {
  if ((op == "/" || op == "%") && b == 0) throw Unreadable{};
  if ((op == "<<" || op == ">>") && (b < 0 || b > 62)) throw Unreadable{};
  if (op == "|") return a | b;
  if (op == "^") return a ^ b;
  if (op == "&") return a & b;
  if (op == "==") return a == b;
  if (op == "!=") return a != b;
  if (op == "<") return a < b;
  if (op == ">") return a > b;
  if (op == "<=") return a <= b;
  if (op == ">=") return a >= b;
  if (op == "<<") return a << b;
  if (op == ">>") return a >> b;
  if (op == "+") return a + b;
  if (op == "-") return a - b;
  if (op == "*") return a * b;
  return op == "/" ? a / b : a % b;
}

// What one known side decides alone is known, whatever the other side is.
Value combine(const std::string& op, Value a, Value b) {
  if (op == "&&") {
    if ((a && *a == 0) || (b && *b == 0)) return 0;
    return a && b ? Value(1) : std::nullopt;
  }
  if (op == "||") {
    if ((a && *a != 0) || (b && *b != 0)) return 1;
    return a && b ? Value(0) : std::nullopt;
  }
  return a && b ? Value(arithmetic(op, *a, *b)) : std::nullopt;
}

class Parser {
public:
  Parser(const std::string& text, const Macros& macros, int depth)
      : tokens_(tokens_of(text)), macros_(macros), depth_(depth) {
    if (depth > deepest_macro) throw Unreadable{};
  }

  Value parse() {
    const Value value = conditional();
    if (at_ != tokens_.size()) throw Unreadable{};
    return value;
  }

private:
  [[nodiscard]] std::string peek() const { return at_ < tokens_.size() ? tokens_[at_] : std::string(); }
  std::string take() {
    if (at_ == tokens_.size()) throw Unreadable{};
    return tokens_[at_++];
  }
  bool skip(const std::string& token) {
    if (peek() != token) return false;
    ++at_;
    return true;
  }
  void expect(const std::string& token) {
    if (!skip(token)) throw Unreadable{};
  }

  Value conditional() {
    const Value condition = binary(1);
    if (!skip("?")) return condition;
    const Value yes = conditional();
    expect(":");
    const Value no = conditional();
    if (!condition) return std::nullopt;
    return *condition != 0 ? yes : no;
  }

  Value binary(int lowest) {
    Value left = unary();
    for (int level = precedence(peek()); level >= lowest; level = precedence(peek())) {
      const std::string op = take();
      left = combine(op, left, binary(level + 1));
    }
    return left;
  }

  Value unary() {
    const std::string token = take();
    if (token == "(") {
      const Value value = conditional();
      expect(")");
      return value;
    }
    if (token == "!" || token == "-" || token == "+" || token == "~") {
      const Value value = unary();
      if (!value) return value;
      if (token == "!") return *value == 0;
      if (token == "~") return ~*value;
      return token == "-" ? -*value : *value;
    }
    if (token == "defined") return defined();
    if (begins_name(token[0])) return name(token);
    return number(token);
  }

  Value defined() {
    const bool parenthesis = skip("(");
    const std::string name = take();
    if (parenthesis) expect(")");
    const auto known = macros_.defined(name);
    return known ? Value(*known ? 1 : 0) : std::nullopt;
  }

  Value name(const std::string& name) {
    if (peek() == "(") { // a macro with parameters, or a question to the compiler such as __has_builtin
      skip_parentheses();
      return std::nullopt;
    }
    const auto known = macros_.defined(name);
    if (!known) return std::nullopt;
    if (!*known) return 0;
    const auto value = macros_.value(name);
    return value ? Parser(*value, macros_, depth_ + 1).parse() : std::nullopt;
  }

  void skip_parentheses() {
    int open = 0;
    do {
      const std::string token = take();
      open += token == "(" ? 1 : token == ")" ? -1 : 0;
    } while (open > 0);
  }

  static Value number(const std::string& token) {
    try {
      std::size_t used = 0;
      const auto value = std::stoll(token, &used, 0);
      if (token.find_first_not_of("uUlL", used) != std::string::npos) throw Unreadable{};
      return value;
    } catch (const std::logic_error&) {
      throw Unreadable{};
    }
  }

  std::vector<std::string> tokens_;
  const Macros& macros_;
  int depth_;
  std::size_t at_ = 0;
};

} // namespace

std::optional<bool> evaluate(const std::string& expression, const Macros& macros) {
  try {
    const Value value = Parser(expression, macros, 0).parse();
    return value ? std::optional(*value != 0) : std::nullopt;
  } catch (const Unreadable&) {
    return std::nullopt;
  }
}

} // namespace phlux::device
