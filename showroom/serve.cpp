// SPDX-License-Identifier: GPL-3.0-or-later
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "vitrine/showroom.hpp"

namespace vitrine {
namespace {

namespace fs = std::filesystem;

/// The file that a request's path (decoded) means, or nothing: only what lies inside `root` when all links are
/// followed.
fs::path file_in(const fs::path& root, const std::string& path) {
  if (path.empty() || path[0] != '/' || path.size() > 2048 || path.find('\0') != std::string::npos) return {};
  std::error_code failed;
  fs::path file = fs::canonical(root / path.substr(1), failed);
  if (failed) return {};
  if (fs::is_directory(file, failed)) file = fs::canonical(file / "index.html", failed);
  if (failed || !fs::is_regular_file(file, failed)) return {};
  const auto [end, rest] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return end == root.end() ? file : fs::path();
}

std::string type_of(const fs::path& file) {
  static const std::map<std::string, const char*> types{{".html", "text/html; charset=utf-8"},
                                                        {".js", "text/javascript; charset=utf-8"},
                                                        {".css", "text/css; charset=utf-8"},
                                                        {".json", "application/json"},
                                                        {".webp", "image/webp"},
                                                        {".jpg", "image/jpeg"},
                                                        {".png", "image/png"},
                                                        {".glb", "model/gltf-binary"},
                                                        {".svg", "image/svg+xml"},
                                                        {".txt", "text/plain; charset=utf-8"}};
  const auto found = types.find(file.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

void answer(const fs::path& root, const httplib::Request& request, httplib::Response& response) {
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-cache");
  // A page elsewhere that has its name point here does not read the site.
  const std::string host = request.get_header_value("Host");
  const std::string name = host.substr(0, host.find(':'));
  if (name != "127.0.0.1" && name != "localhost") {
    response.status = 403;
    return;
  }
  const fs::path file = file_in(root, request.path);
  if (file.empty()) {
    response.status = 404;
    response.set_content("Not found\n", "text/plain; charset=utf-8");
    return;
  }
  std::error_code failed;
  const bool folder = fs::is_directory(root / request.path.substr(1), failed);
  if (folder && request.path.back() != '/') {
    // Relative addresses in the page are meant from inside the folder. The path begins with one slash, or it would name
    // another host.
    const std::string inside = "/" + fs::relative(file.parent_path(), root, failed).generic_string() + "/";
    response.set_redirect(inside);
    return;
  }
  const std::uintmax_t size = fs::file_size(file, failed);
  auto stream = std::make_shared<std::ifstream>(file, std::ios::binary);
  if (failed || !*stream) {
    response.status = 404;
    return;
  }
  if (size == 0) return response.set_content("", type_of(file).c_str());
  response.set_content_provider(size, type_of(file).c_str(),
                                [stream](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                  char block[1 << 16];
                                  stream->clear();
                                  stream->seekg(static_cast<std::streamoff>(offset));
                                  stream->read(block, static_cast<std::streamsize>(std::min(length, sizeof block)));
                                  if (stream->gcount() <= 0) return false;
                                  return sink.write(block, static_cast<std::size_t>(stream->gcount()));
                                });
}

}  // namespace

Result<int> serve_site(const ServeOptions& options, const std::function<void(int port)>& ready,
                       const std::function<bool()>& stop) {
  std::error_code failed;
  const fs::path root = fs::canonical(options.site, failed);
  if (failed || !fs::is_regular_file(root / "index.html", failed))
    return Error{Cause::missing, "NO_SITE", options.site + ": no index.html there",
                 "make the site first: vitrine showroom CATALOGUE --out " + options.site, "showroom"};
  httplib::Server server;
  server.new_task_queue = [] { return new httplib::ThreadPool(8); };
  server.set_payload_max_length(1024);
  server.set_read_timeout(10, 0);
  server.set_write_timeout(30, 0);
  server.set_keep_alive_max_count(100);
  server.set_keep_alive_timeout(5);
  const auto handle = [&root](const httplib::Request& request, httplib::Response& response) {
    answer(root, request, response);
  };
  server.Get(".*", handle);  // HEAD too: the library asks the same and sends no body
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (request.method == "GET" || request.method == "HEAD") return httplib::Server::HandlerResponse::Unhandled;
    response.status = 405;
    response.set_header("Allow", "GET, HEAD");
    return httplib::Server::HandlerResponse::Handled;
  });
  int port = options.port;
  if (port == 0)
    port = server.bind_to_any_port("127.0.0.1");
  else if (!server.bind_to_port("127.0.0.1", port))
    port = -1;
  if (port <= 0)
    return Error{Cause::unwritable, "PORT", "port " + std::to_string(options.port) + " of this machine cannot be had",
                 "name another with --port, or leave it out for a free one", "showroom"};
  std::atomic<bool> over{false};
  std::thread watch([&] {
    while (!over && !stop()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.stop();
  });
  ready(port);
  const bool good = server.listen_after_bind();
  over = true;
  watch.join();
  if (!good && !stop())
    return Error{Cause::internal, "SERVER", "the server ended by itself", "start it again", "showroom"};
  return port;
}

}  // namespace vitrine
