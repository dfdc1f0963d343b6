// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "pipeline_checks.hpp"

namespace vitrine::validation {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) { EVP_DigestInit_ex(context_, EVP_sha256(), nullptr); }
  ~Sha256() { EVP_MD_CTX_free(context_); }
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;
  void add(const void* bytes, std::size_t size) { EVP_DigestUpdate(context_, bytes, size); }
  void add(const std::string& text) { add(text.c_str(), text.size() + 1); }
  void add(double value) {
    char text[48];
    std::snprintf(text, sizeof text, "%a", value);
    add(std::string(text));
  }
  void add(int value) { add(static_cast<double>(value)); }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned size = 0;
    EVP_DigestFinal_ex(context_, digest.data(), &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[digest[i] >> 4];
      text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
  }

 private:
  EVP_MD_CTX* context_;
};

std::string files_digest(const Conversion& item) {
  Sha256 hash;
  for (const Bytes* file : {&item.garment_glb, &item.dressed_glb, &item.preview_png}) {
    hash.add(static_cast<int>(file->size()));
    hash.add(file->data(), file->size());
  }
  return hash.hex();
}

/// What a program prints, and its exit code; standard error goes where it went.
struct ProgramOutput {
  std::string text;
  int exit_code = -1;
};
ProgramOutput run_program(const std::vector<std::string>& arguments) {
  ProgramOutput output;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return output;
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    std::vector<char*> list;
    for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
    list.push_back(nullptr);
    ::execv(list[0], list.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  char buffer[4096];
  for (ssize_t n; pid > 0 && ((n = ::read(ends[0], buffer, sizeof buffer)) > 0 || (n < 0 && errno == EINTR));)
    if (n > 0) output.text.append(buffer, static_cast<std::size_t>(n));
  ::close(ends[0]);
  int status = 0;
  if (pid > 0 && ::waitpid(pid, &status, 0) == pid && WIFEXITED(status)) output.exit_code = WEXITSTATUS(status);
  return output;
}

void check_other_process(const Session& session, const Subject& subject, const DrawnItem& item,
                         const std::string& expected) {
  const ValidateOptions& options = session.options;
  if (options.program.empty()) return session.skip("determinism.process", "the program's own path is not known");
  session.begin("determinism.process");
  std::vector<std::string> arguments = {options.program, "plugin",
                                        "digest",        subject.file.path.string(),
                                        "--garment",     item.request.garment.id,
                                        "--neckline",    item.request.neckline,
                                        "--front",       item.request.front,
                                        "--back",        item.request.back};
  if (!options.partners.built_in) arguments.push_back("--alone");
  for (const auto& folder : options.partners.folders)
    arguments.insert(arguments.end(), {"--plugin-dir", folder.string()});
  for (const auto& file : options.partners.files) arguments.insert(arguments.end(), {"--plugin", file.string()});
  const ProgramOutput output = run_program(arguments);
  if (output.exit_code != 0)
    session.fail("determinism.process", "the other process ended with exit code " + std::to_string(output.exit_code));
  else if (output.text != expected + "\n")
    session.fail("determinism.process", "another process read other tables or wrote other bytes");
  else
    session.pass("determinism.process");
}

void check_files(const Session& session, const Subject& subject, const DrawnItem& item) {
  session.begin("pipeline.files");
  const Conversion once = convert(item.request);
  if (once.error || once.garment_glb.empty() || once.preview_png.empty()) {
    session.fail("pipeline.files",
                 item.what + ": " + (once.error ? once.error->code + " in " + once.error->stage : "a file is empty"));
    session.skip("determinism.repeat", "nothing was converted");
    session.skip("determinism.process", "nothing was converted");
    return;
  }
  session.pass("pipeline.files", std::to_string(once.garment_glb.size() / 1024) + " kB");
  if (!session.wants(5)) return;
  session.begin("determinism.repeat");
  const std::string files = files_digest(once);
  session.conclude("determinism.repeat", files_digest(convert(item.request)) == files
                                             ? std::vector<std::string>{}
                                             : std::vector<std::string>{"the second conversion wrote other bytes"});
  check_other_process(session, subject, item, template_digest(subject.plugin) + " " + files);
}

}  // namespace

std::string template_digest(const AdoptedPlugin& plugin) {
  Sha256 hash;
  for (const std::string& text : {plugin.identity.id, plugin.identity.version, plugin.identity.vendor}) hash.add(text);
  for (const GarmentTemplate& g : plugin.garments) {
    hash.add(g.id);
    hash.add(g.title);
    for (const TemplateFeature& f : g.features) {
      hash.add(f.name);
      hash.add(f.landmark);
      hash.add(f.mirror);
      hash.add(static_cast<int>(f.turn));
    }
    for (const TemplatePose& pose : g.poses) {
      hash.add(pose.name);
      for (std::size_t i = 0; i < pose.uv.size(); ++i)
        for (const double value : {pose.uv[i].x(), pose.uv[i].y(), pose.radius[i]}) hash.add(value);
    }
    for (const TemplateEdge& e : g.edges) {
      hash.add(e.name);
      for (const int value : {e.from, e.to, static_cast<int>(e.kind)}) hash.add(value);
    }
    for (const TemplateSeam& s : g.seams)
      for (const int value :
           {s.edge_a, s.edge_b, static_cast<int>(s.side_a), static_cast<int>(s.side_b), int{s.reversed}})
        hash.add(value);
    for (const TemplateLimb& l : g.limbs) {
      hash.add(l.name);
      for (const int value : {l.root_a, l.root_b, l.tip_a, l.tip_b}) hash.add(value);
      for (const std::string& landmark : l.chain) hash.add(landmark);
    }
    for (const int value : {g.scale.feature_a, g.scale.feature_b, g.scale.top, g.scale.bottom}) hash.add(value);
    hash.add(g.scale.girth);
    hash.add(g.scale.ease);
    for (const int anchor : g.anchors) hash.add(anchor);
    for (const Fabric& f : g.fabrics) {
      hash.add(f.name);
      for (const double value : {f.stretch, f.shear, f.bend, f.mass, f.friction}) hash.add(value);
    }
  }
  for (const NecklineTemplate& n : plugin.necklines) {
    hash.add(n.id);
    hash.add(n.title);
    for (const Vec2& p : n.profile) {
      hash.add(p.x());
      hash.add(p.y());
    }
    for (const double value : {n.ratio_min, n.ratio_max, n.default_depth}) hash.add(value);
  }
  return hash.hex();
}

std::string bytes_digest(const std::vector<MemoryRange>& ranges) {
  Sha256 hash;
  for (const MemoryRange& range : ranges) hash.add(reinterpret_cast<const void*>(range.begin), range.end - range.begin);
  return hash.hex();
}

void check_determinism(const Session& session, const Subject& subject, const DrawnItem* item,
                       const std::string& tables_before) {
  if (item != nullptr) {
    check_files(session, subject, *item);
  } else {
    for (const char* check : {"pipeline.files", "determinism.repeat", "determinism.process"})
      session.skip(check, "there is no sound item to convert");
  }
  if (!session.wants(5)) return;
  session.begin("determinism.tables");
  session.conclude("determinism.tables",
                   bytes_digest(subject.tables) == tables_before
                       ? std::vector<std::string>{}
                       : std::vector<std::string>{"a table or text has changed since it was read"});
}

}  // namespace vitrine::validation

namespace vitrine {

Result<std::string> conversion_digest(const DigestRequest& request, const std::shared_ptr<const Body>& body) {
  const auto file = open_plugin_file(request.file);
  if (!file) return file.error();
  const auto library = load_library(*file);
  if (!library) return library.error();
  const auto plugin = adopt(*library, request.file);
  if (!plugin) return plugin.error();
  const PluginRegistry registry = PluginRegistry::load(request.partners);
  ConvertRequest convert_request;
  const GarmentTemplate* garment = registry.find_garment(request.garment);
  for (const GarmentTemplate& own : plugin->garments)
    if (own.id == request.garment) garment = &own;
  if (garment == nullptr)
    return Error{Cause::plugin, "UNKNOWN_GARMENT", "no plugin supplies the garment \"" + request.garment + "\"",
                 "name its folder with --plugin-dir", ""};
  convert_request.name = garment->id;
  convert_request.garment = *garment;
  convert_request.necklines = plugin->necklines;
  for (const NecklineTemplate& n : registry.necklines())
    if (n.plugin != plugin->identity.id) {
      bool own = false;
      for (const NecklineTemplate& other : plugin->necklines) own = own || other.id == n.id;
      if (!own) convert_request.necklines.push_back(n);
    }
  convert_request.neckline = request.neckline;
  convert_request.front = request.front;
  convert_request.back = request.back;
  convert_request.quality = Quality::draft;
  convert_request.texture.max_size = 512;
  convert_request.body = body;
  const Conversion item = convert(convert_request);
  return validation::template_digest(*plugin) + " " + validation::files_digest(item);
}

}  // namespace vitrine
