// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

#include "shop.hpp"

// After Eigen, whose parameters have the name of a macro that this brings along.
#include <httplib.h>

using namespace vitrine;

namespace {

class Serve : public testing::Test {
 protected:
  void SetUp() override {
    shop.item("a", "A vest");
    ASSERT_TRUE(make_showroom(shop.options));
    std::ofstream(shop.root / "secret.txt") << "secret";
    fs::create_symlink(shop.root / "secret.txt", shop.root / "site/link.txt");
    std::promise<int> told;
    thread = std::thread([&] {
      const auto done = serve_site(
          {shop.options.out, 0}, [&](int p) { told.set_value(p); }, [&] { return over.load(); });
      good = static_cast<bool>(done);
    });
    client = std::make_unique<httplib::Client>("127.0.0.1", told.get_future().get());
  }
  void TearDown() override {
    over = true;
    if (thread.joinable()) thread.join();
    EXPECT_TRUE(good);
  }
  Shop shop;
  std::atomic<bool> over{false}, good{false};
  std::thread thread;
  std::unique_ptr<httplib::Client> client;
};

}  // namespace

TEST_F(Serve, gives_files_with_their_types) {
  const auto page = client->Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page->body, slurp(shop.root / "site/index.html"));
  EXPECT_EQ(client->Get("/app/grid.js")->get_header_value("Content-Type"), "text/javascript; charset=utf-8");
  const auto model = client->Get("/item/a/dressed.glb");
  EXPECT_EQ(model->get_header_value("Content-Type"), "model/gltf-binary");
  EXPECT_EQ(model->body, slurp(shop.root / "site/item/a/dressed.glb"));
}

TEST_F(Serve, gives_nothing_outside_of_the_site) {
  for (const char* path : {"/../secret.txt", "/item/../../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
                           "//etc/passwd", "/etc/passwd", "/link.txt", "/item/a/%00", "/item/none/index.html"}) {
    const auto answer = client->Get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_GE(answer->status, 400) << path;
    EXPECT_EQ(answer->body.find("secret"), std::string::npos) << path;
  }
}

TEST_F(Serve, takes_get_and_head_alone_and_no_other_hosts_name) {
  EXPECT_EQ(client->Head("/")->status, 200);
  EXPECT_EQ(client->Post("/", "x", "text/plain")->status, 405);
  EXPECT_EQ(client->Delete("/")->status, 405);
  EXPECT_EQ(client->Get("/", {{"Host", "shop.example"}})->status, 403);
  EXPECT_EQ(client->Get("/", {{"Host", "localhost.shop.example:80"}})->status, 403);
}
