#include "io/yaml_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

#include "io/input_error.h"

namespace io {
namespace {

constexpr std::size_t kMaxYamlDepth = 8;  // a scene, the deepest of our files, needs 6

/// Builds the tree from the parser's events; refuses while it reads, so that a hostile document
/// costs nothing.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}
  YamlNode& root() { return root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Add(NodeAt(mark, anchor, YamlNode::Kind::kNothing));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    NodeAt(mark, anchor, YamlNode::Kind::kNothing);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    YamlNode node = NodeAt(mark, anchor, YamlNode::Kind::kScalar);
    node.text = text;
    node.quoted = tag == "!";
    Add(std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Enter(NodeAt(mark, anchor, YamlNode::Kind::kList));
  }
  void OnSequenceEnd() override { Leave(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Enter(NodeAt(mark, anchor, YamlNode::Kind::kMapping));
  }
  void OnMapEnd() override { Leave(); }

 private:
  /// A list or mapping whose end has not been read.
  struct Open {
    YamlNode node;
    bool has_key = false;  ///< the key of the next entry was read
    std::string key;
    int key_line = 0;
  };

  [[noreturn]] void Fail(int line, const std::string& what) const {
    throw InputError(Where(file_, line), what);
  }

  YamlNode NodeAt(const YAML::Mark& mark, YAML::anchor_t anchor, YamlNode::Kind kind) const {
    YamlNode node;
    node.kind = kind;
    node.line = std::max(mark.line, 0) + 1;
    if (anchor != 0) {
      Fail(node.line, "anchors and aliases are not part of the format; write the value out");
    }
    return node;
  }

  void Enter(YamlNode node) {
    if (open_.size() >= kMaxYamlDepth) {
      Fail(node.line, "nested deeper than " + std::to_string(kMaxYamlDepth) +
                          " levels; our files need fewer");
    }
    open_.emplace_back().node = std::move(node);
  }

  void Leave() {
    YamlNode node = std::move(open_.back().node);
    open_.pop_back();
    Add(std::move(node));
  }

  /// Puts a whole node where it belongs: it may be the key of the entry that follows.
  void Add(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::kMapping && !parent.has_key) {
      TakeKey(node, parent);
      return;
    }
    node.key = std::move(parent.key);
    node.key_line = parent.key_line;
    parent.has_key = false;
    parent.node.entries.push_back(std::move(node));
  }

  void TakeKey(const YamlNode& node, Open& parent) const {
    if (node.kind != YamlNode::Kind::kScalar) Fail(node.line, "a key must be a plain text");
    for (const YamlNode& entry : parent.node.entries) {
      if (entry.key == node.text) {
        Fail(node.line, "key " + Quoted(node.text) + " is given twice; keep one");
      }
    }
    parent.has_key = true;
    parent.key = node.text;
    parent.key_line = node.line;
  }

  std::string file_;
  std::vector<Open> open_;
  YamlNode root_;
};

}  // namespace

YamlNode ParseYamlTree(const std::string& text, const std::string& file) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    TreeBuilder builder(file);
    if (parser.HandleNextDocument(builder)) {
      YamlNode root = std::move(builder.root());
      if (!parser.HandleNextDocument(builder)) return root;
      throw InputError(file, "holds more than one YAML document; keep one");
    }
    return {};
  } catch (const YAML::Exception& error) {
    throw InputError(Where(file, std::max(error.mark.line, 0) + 1),
                     "not valid YAML: " + error.msg + "; expected `key: value` lines");
  }
}

}  // namespace io
