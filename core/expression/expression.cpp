#include "core/expression/expression.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace gaitlab::expression {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n'; }

struct Token {
  enum class Kind { number, name, sign, end } kind = Kind::end;
  std::size_t offset = 0;
  std::string_view text = {};
  double number = 0;
};

std::string quoted(std::string_view text) { return "'" + std::string(text.substr(0, 40)) + (text.size() > 40 ? "...'" : "'"); }

std::string found(const Token& token) {
  return "found " + (token.kind == Token::Kind::end ? "the end of the text" : quoted(token.text));
}

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  /// The text up to the next `]`, without blanks at both ends. The position advances past the `]`.
  Token bracketed() {
    const std::size_t end = text_.find(']', at_);
    if (end == std::string_view::npos) throw Fault{text_.size(), "found the end of the text; expected ']'"};
    std::size_t begin = at_;
    std::size_t last = end;
    while (begin < last && is_space(text_[begin])) ++begin;
    while (last > begin && is_space(text_[last - 1])) --last;
    at_ = end + 1;
    if (begin == last) throw Fault{begin, "found nothing in [ ]; expected the name of a joint"};
    return {Token::Kind::name, begin, text_.substr(begin, last - begin)};
  }

  Token next() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (at_ == text_.size()) return {Token::Kind::end, at_};
    const char c = text_[at_];
    const bool point = c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
    if (is_digit(c) || point) return number();
    if (is_letter(c) || c == '_') return name();
    return sign();
  }

 private:
  std::size_t digits(std::size_t at) const {
    while (at < text_.size() && is_digit(text_[at])) ++at;
    return at;
  }

  Token number() {
    const std::size_t begin = at_;
    std::size_t end = digits(begin);
    if (end - begin > 1 && text_[begin] == '0') {
      throw Fault{begin, "found " + quoted(text_.substr(begin, end - begin)) + "; expected a number without a leading zero"};
    }
    if (end < text_.size() && text_[end] == '.') end = digits(end + 1);
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      const bool sign = end + 1 < text_.size() && (text_[end + 1] == '+' || text_[end + 1] == '-');
      const std::size_t exponent = end + (sign ? 2 : 1);
      if (digits(exponent) > exponent) end = digits(exponent);  // otherwise the `e` belongs to a name, which is refused later
    }
    at_ = end;
    Token token{Token::Kind::number, begin, text_.substr(begin, end - begin)};
    const auto [last, failure] = std::from_chars(token.text.data(), token.text.data() + token.text.size(), token.number);
    const bool zero = token.text.find_first_of("123456789") >= std::min(token.text.find_first_of("eE"), token.text.size());
    // Overflow and underflow are checked here, because versions of from_chars report an underflow differently.
    if (failure != std::errc() || !std::isfinite(token.number) || (token.number == 0 && !zero)) {
      throw Fault{begin, "found " + quoted(token.text) + "; expected a number that fits a double"};
    }
    return token;
  }

  void word() {
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_')) ++at_;
  }

  Token name() {
    const std::size_t begin = at_;
    word();
    const auto dotted = [&] {
      return at_ + 1 < text_.size() && text_[at_] == '.' && (is_letter(text_[at_ + 1]) || text_[at_ + 1] == '_');
    };
    while (dotted()) {
      ++at_;
      word();
    }
    return {Token::Kind::name, begin, text_.substr(begin, at_ - begin)};
  }

  Token sign() {
    const std::size_t begin = at_;
    for (const std::string_view two : {"<=", ">=", "==", "!="}) {
      if (text_.substr(begin, 2) == two) at_ += 2;
    }
    if (at_ == begin && std::string_view("+-*/^()[],<>").find(text_[begin]) != std::string_view::npos) ++at_;
    if (at_ > begin) return {Token::Kind::sign, begin, text_.substr(begin, at_ - begin)};
    if (text_[begin] == '=') throw Fault{begin, "found '='; compare with '=='"};
    do {
      ++at_;
      // Remaining bytes of a UTF-8 character.
    } while (at_ < text_.size() && (static_cast<unsigned char>(text_[at_]) & 0xC0U) == 0x80);
    throw Fault{begin, "found " + quoted(text_.substr(begin, at_ - begin)) + ", which has no meaning here"};
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

class Parser {
 public:
  Parser(std::string_view text, NameSyntax names) : lexer_(text), names_(names) { advance(); }

  Term whole() {
    Term term = expression();
    if (token_.kind != Token::Kind::end) refuse("an operator or the end of the text");
    return term;
  }

 private:
  /// Counts one level of nesting during the lifetime of this object.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser.levels_ > kMostLevels) {
        throw Fault{parser.token_.offset, "nested deeper than " + std::to_string(kMostLevels) + " levels"};
      }
    }
    ~Level() { --parser_.levels_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  [[noreturn]] void refuse(const std::string& expected) const {
    throw Fault{token_.offset, found(token_) + "; expected " + expected};
  }

  [[nodiscard]] bool at(std::string_view text) const { return token_.kind != Token::Kind::end && token_.text == text; }
  void advance() { token_ = lexer_.next(); }
  void take(std::string_view text, const std::string& expected) {
    if (!at(text)) refuse(expected);
    advance();
  }

  Term node(Term term) {
    if (++terms_ > kMostTerms) {
      throw Fault{term.offset, "more than " + std::to_string(kMostTerms) + " numbers, names and operators"};
    }
    return term;
  }

  Term call(std::string_view name, std::size_t offset, Term a) {
    Term term{Term::Kind::call, offset, std::string(name)};
    term.arguments.push_back(std::move(a));
    return node(std::move(term));
  }
  Term call(std::string_view name, std::size_t offset, Term a, Term b) {
    Term term = call(name, offset, std::move(a));
    term.arguments.push_back(std::move(b));
    return term;
  }

  /// Parses a chain of operators of equal precedence, which associate from the left.
  template <class Operand>
  Term chain(std::initializer_list<std::string_view> signs, Operand operand) {
    Term left = operand();
    while (true) {
      const Token sign = token_;
      bool here = false;
      for (const std::string_view one : signs) here = here || at(one);
      if (!here) return left;
      advance();
      Term right = operand();
      left = call(sign.text, sign.offset, std::move(left), std::move(right));
    }
  }

  Term expression() {
    return chain({"or"}, [this] { return chain({"and"}, [this] { return negation(); }); });
  }

  Term negation() {
    if (!at("not")) return comparison();
    const Level level(*this);
    const std::size_t offset = token_.offset;
    advance();
    return call("not", offset, negation());
  }

  [[nodiscard]] bool compares() const {
    for (const std::string_view sign : {"<", "<=", ">", ">=", "==", "!="}) {
      if (at(sign)) return true;
    }
    return false;
  }

  Term comparison() {
    Term left = addition();
    if (!compares()) return left;
    const Token sign = token_;
    advance();
    Term right = addition();
    if (compares()) throw Fault{token_.offset, found(token_) + " after a comparison; write a < b and b < c"};
    return call(sign.text, sign.offset, std::move(left), std::move(right));
  }

  Term addition() {
    return chain({"+", "-"}, [this] { return chain({"*", "/"}, [this] { return factor(); }); });
  }

  Term factor() {
    const Level level(*this);
    const Token sign = token_;
    if (at("+")) {
      advance();
      return factor();
    }
    if (at("-")) {
      advance();
      return call("~", sign.offset, factor());
    }
    Term base = primary();
    const std::size_t power = token_.offset;
    if (!at("^")) return base;
    advance();
    return call("^", power, std::move(base), factor());
  }

  Term primary() {
    const Token token = token_;
    if (token.kind == Token::Kind::number) {
      advance();
      Term term{Term::Kind::number, token.offset};
      term.number = token.number;
      return node(std::move(term));
    }
    const bool word = at("and") || at("or") || at("not") || at("in");
    if (token.kind == Token::Kind::name && !word) return named();
    if (!at("(")) refuse("a number, a name or '('");
    advance();
    Term inner = expression();
    take(")", "an operator or ')'");
    return inner;
  }

  Term named() {
    const Token name = token_;
    advance();
    Term term{Term::Kind::name, name.offset, std::string(name.text)};
    if (at("[") && names_ == NameSyntax::figures) {
      term.joint = lexer_.bracketed().text;
      advance();
    } else if (at("[")) {
      advance();
      term.index = index();
    } else if (at("(")) {
      advance();
      term.kind = Term::Kind::call;
      if (name.text == "sum" && names_ == NameSyntax::joints) {
        term.kind = Term::Kind::sum;
        take("j", "'j': sum(j in neighbours, TERM)");
        take("in", "'in': sum(j in neighbours, TERM)");
        take("neighbours", "'neighbours': sum(j in neighbours, TERM)");
        take(",", "',': sum(j in neighbours, TERM)");
      }
      if (at(")")) refuse("a number, a name or '('");
      term.arguments.push_back(expression());
      while (term.kind == Term::Kind::call && at(",")) {
        advance();
        term.arguments.push_back(expression());
      }
      take(")", term.kind == Term::Kind::sum ? "an operator or ')'" : "an operator, ',' or ')'");
    }
    return node(std::move(term));
  }

  Term::Index index() {
    const bool first = at("i");
    if (!first && !at("j")) refuse("i or j");
    advance();
    if (first && at(",")) {
      advance();
      take("j", "j");
      take("]", "']'");
      return Term::Index::ij;
    }
    take("]", "']'");
    return first ? Term::Index::i : Term::Index::j;
  }

  Lexer lexer_;
  NameSyntax names_;
  Token token_;
  std::size_t terms_ = 0, levels_ = 0;
};

}  // namespace

Term parse(const std::string& text, NameSyntax names) {
  if (text.size() > kMostText) {
    throw Fault{kMostText, "longer than " + std::to_string(kMostText) + " characters"};
  }
  return Parser(text, names).whole();
}

}  // namespace gaitlab::expression
