// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iomanip>
#include <sstream>

#include "mesh_check.hpp"
#include "shapes.hpp"

namespace vitrine {
namespace {

using test::box_mesh;
using test::write_obj;
using test::write_text;

const Mannequin& reference() {
  static const Mannequin body = *build_mannequin({});
  return body;
}

void expect_refused(const std::string& path, const std::string& code, int exit_code = 65) {
  const Result<Mannequin> body = import_mannequin(path);
  ASSERT_FALSE(body) << path;
  EXPECT_EQ(body.error().code, code) << body.error().message;
  EXPECT_EQ(body.error().exit_code(), exit_code);
  EXPECT_THAT(body.error().message, testing::HasSubstr(path));
  EXPECT_FALSE(body.error().remedy.empty());
}

TEST(ImportMannequin, finds_on_the_mesh_what_the_builder_knew) {
  const Result<Mannequin> body = import_mannequin(write_obj("metres", reference().mesh));
  ASSERT_TRUE(body) << body.error().message;
  for (const auto& [name, p] : reference().landmarks) {
    ASSERT_EQ(body->landmarks.count(name), 1u) << name;
    const Vec3 q = body->landmarks.at(name);
    const bool limb = name.find("elbow") == 0 || name.find("wrist") == 0 || name.find("biceps") == 0;
    EXPECT_NEAR(q.x(), p.x(), limb ? 0.05 : 0.035) << name;
    EXPECT_NEAR(q.y(), p.y(), 0.045) << name;
  }
  for (const char* name : {"bust", "waist", "hip", "height", "inside_leg", "arm", "biceps", "thigh"})
    EXPECT_NEAR(body->girths.at(name) / reference().girths.at(name), 1, 0.04) << name;
  EXPECT_EQ(body->source, "mannequin_metres.obj");
}

TEST(ImportMannequin, guesses_metres_centimetres_and_millimetres_and_stands_the_body_on_the_floor) {
  for (const double unit : {1.0, 100.0, 1000.0}) {
    const Result<Mannequin> body = import_mannequin(write_obj("unit", reference().mesh, unit, Vec3(0.4, 0.7, -0.3)));
    ASSERT_TRUE(body) << unit << ": " << body.error().message;
    EXPECT_NEAR(body->girths.at("height"), 1.72, 1e-3);
    Vec3 low = Vec3::Constant(9), high = -low;
    for (const Vec3& v : body->mesh.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    EXPECT_NEAR(low.y(), 0, 1e-6);
    EXPECT_NEAR(low.x() + high.x(), 0, 0.004);
  }
}

TEST(ImportMannequin, takes_a_body_of_67_units_for_inches_and_one_of_five_for_nothing) {
  const Result<Mannequin> body = import_mannequin(write_obj("inches", reference().mesh, 1 / 0.0254));
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_NEAR(body->girths.at("height"), 1.72, 1e-3);
  ASSERT_EQ(body->warnings.size(), 1u);
  EXPECT_NE(body->warnings[0].find("inches"), std::string::npos);
  expect_refused(write_obj("feet", reference().mesh, 1 / 0.3048), "NOT_A_BODY");
}

TEST(ImportMannequin, leaves_a_body_without_feet_as_it_stands) {
  // Toes and heels cut back to the ankle: stumps tell nothing about the front.
  TriMesh mesh = reference().mesh;
  for (Vec3& v : mesh.vertices)
    if (v.y() < 0.12) v.z() = std::clamp(v.z(), -0.06, 0.02);
  const Result<Mannequin> body = import_mannequin(write_obj("stumps", mesh));
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_GT(body->landmarks.at("neck_front").z(), body->landmarks.at("neck_back").z());
  for (const std::string& warning : body->warnings) EXPECT_EQ(warning.find("turned around"), std::string::npos);
}

TEST(ImportMannequin, turns_around_a_body_whose_feet_point_to_the_back) {
  TriMesh mesh = reference().mesh;
  for (Vec3& v : mesh.vertices) v = Vec3(-v.x(), v.y(), -v.z());
  const Result<Mannequin> turned = import_mannequin(write_obj("backwards", mesh));
  const Result<Mannequin> straight = import_mannequin(write_obj("forwards", reference().mesh));
  ASSERT_TRUE(turned && straight);
  ASSERT_EQ(turned->warnings.size(), 1u);
  EXPECT_NE(turned->warnings[0].find("turned around"), std::string::npos);
  EXPECT_TRUE(straight->warnings.empty());
  for (const auto& [name, girth] : straight->girths) EXPECT_NEAR(turned->girths.at(name), girth, 0.002) << name;
}

TEST(ImportMannequin, turns_an_inside_out_mesh) {
  TriMesh mesh = reference().mesh;
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  const Result<Mannequin> body = import_mannequin(write_obj("inside_out", mesh));
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_GT(body::signed_volume(body->mesh), 0);
}

TEST(ImportMannequin, welds_a_triangle_soup) {
  TriMesh soup;
  for (const Triangle& t : reference().mesh.triangles) {
    const auto base = static_cast<std::uint32_t>(soup.vertices.size());
    for (std::uint32_t v : t) soup.vertices.push_back(reference().mesh.vertices[v]);
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  const Result<Mannequin> body = import_mannequin(write_obj("soup", soup));
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(body->mesh.vertices.size(), reference().mesh.vertices.size());
}

TEST(ImportMannequin, reads_a_ply) {
  std::ostringstream ply;
  const TriMesh& mesh = reference().mesh;
  ply << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n"
      << std::setprecision(9);
  for (const Vec3& v : mesh.vertices) ply << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const Triangle& t : mesh.triangles) ply << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  const Result<Mannequin> body = import_mannequin(write_text("body.ply", ply.str()));
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(body->mesh.triangles.size(), mesh.triangles.size());
}

TEST(ImportMannequin, measures_the_same_body_alike_from_obj_and_dae_in_any_unit_and_up_axis) {
  const TriMesh& mesh = reference().mesh;
  const Result<Mannequin> obj = import_mannequin(write_obj("as_obj", mesh));
  ASSERT_TRUE(obj);
  const auto dae = [&mesh](const char* name, double unit, bool z_up) {
    std::ostringstream text;
    text << std::setprecision(9)
         << "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
         << "<asset><unit meter=\"" << unit << "\"/><up_axis>" << (z_up ? "Z_UP" : "Y_UP") << "</up_axis></asset>"
         << "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\""
         << 3 * mesh.vertices.size() << "\">";
    for (const Vec3& v : mesh.vertices) {
      const Vec3 p = (z_up ? Vec3(v.x(), -v.z(), v.y()) : v) / unit;
      text << p.x() << ' ' << p.y() << ' ' << p.z() << ' ';
    }
    text << "</float_array><technique_common><accessor source=\"#a\" count=\"" << mesh.vertices.size()
         << "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
         << "type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
         << "source=\"#p\"/></vertices><triangles count=\"" << mesh.triangles.size()
         << "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>";
    for (const Triangle& t : mesh.triangles) text << t[0] << ' ' << t[1] << ' ' << t[2] << ' ';
    text
        << "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>"
        << "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
        << "<instance_visual_scene url=\"#s\"/></scene></COLLADA>";
    return import_mannequin(write_text(name, text.str()));
  };
  for (const Result<Mannequin>& body :
       {dae("metres.dae", 1, false), dae("cm.dae", 0.01, false), dae("z.dae", 1, true)}) {
    ASSERT_TRUE(body) << body.error().message;
    for (const auto& [name, girth] : obj->girths) EXPECT_NEAR(body->girths.at(name), girth, 0.001) << name;
  }
}

TEST(ImportMannequin, refuses_files_that_are_missing_or_no_mesh) {
  expect_refused("no_such_mannequin.obj", "MISSING_FILE", 66);
  expect_refused(VITRINE_BINARY_DIR, "MISSING_FILE", 66);
  expect_refused(write_text("empty.obj", ""), "NOT_A_MESH");
  expect_refused(write_text("prose.obj", "Once upon a time there was no mesh.\n"), "NOT_A_MESH");
  expect_refused(write_text("prose.glb", "glTF but not really"), "NOT_A_MESH");
  expect_refused(write_text("prose.ply", "ply\nformat ascii 1.0\nelement vertex 999999999999\nend_header\n"),
                 "NOT_A_MESH");
  expect_refused(write_text("prose.txt", "v 0 0 0"), "NOT_A_MESH");
  expect_refused(write_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "NOT_A_MESH");
  expect_refused(write_text("indices.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "NOT_A_MESH");
}

TEST(ImportMannequin, refuses_vertices_that_are_not_numbers) {
  TriMesh mesh = box_mesh(Vec3(0.2, 0.85, 0.15), Vec3(0, 0.85, 0));
  mesh.vertices[2].x() = std::nan("");
  expect_refused(write_obj("nan", mesh), "NOT_A_MESH");
}

TEST(ImportMannequin, refuses_an_open_mesh) {
  TriMesh mesh = reference().mesh;
  mesh.triangles.resize(mesh.triangles.size() - 5);
  expect_refused(write_obj("open", mesh), "NOT_WATERTIGHT");
}

TEST(ImportMannequin, refuses_what_is_no_standing_body) {
  expect_refused(write_obj("cube", box_mesh(Vec3::Constant(0.85), Vec3::Zero())), "NOT_A_BODY");
  expect_refused(write_obj("board", box_mesh(Vec3(0.25, 0.85, 0.12), Vec3::Zero())), "NOT_A_BODY");
  expect_refused(write_obj("doll", reference().mesh, 0.2), "NOT_A_BODY");
  TriMesh lying = reference().mesh;
  for (Vec3& v : lying.vertices) v = Vec3(v.y(), v.x(), v.z());
  expect_refused(write_obj("lying", lying), "NOT_A_BODY");
  TriMesh pair = reference().mesh;
  const auto base = static_cast<std::uint32_t>(pair.vertices.size());
  for (const Vec3& v : reference().mesh.vertices) pair.vertices.push_back(v + Vec3(0, 0, 0.5));
  for (const Triangle& t : reference().mesh.triangles)
    pair.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  expect_refused(write_obj("pair", pair), "NOT_A_BODY");
}

TEST(ImportMannequin, turns_a_body_that_stands_along_z_upright_and_says_so) {
  TriMesh mesh = reference().mesh;
  for (Vec3& v : mesh.vertices) v = 1000 * Vec3(v.x(), -v.z(), v.y());
  const Result<Mannequin> turned = import_mannequin(write_obj("z_up", mesh));
  ASSERT_TRUE(turned) << turned.error().message;
  EXPECT_NEAR(turned->girths.at("height"), reference().girths.at("height"), 1e-4);
  EXPECT_NEAR(turned->girths.at("hip"), reference().girths.at("hip"), 0.01);
  ASSERT_EQ(turned->warnings.size(), 2u);
  EXPECT_NE(turned->warnings[0].find("+Z"), std::string::npos);
  EXPECT_NE(turned->warnings[1].find("millimetres"), std::string::npos);
}

TEST(ImportMannequin, names_the_place_of_an_open_edge) {
  TriMesh mesh = reference().mesh;
  mesh.triangles.pop_back();
  const Result<Mannequin> body = import_mannequin(write_obj("one_hole", mesh));
  ASSERT_FALSE(body);
  EXPECT_NE(body.error().message.find("3 open"), std::string::npos) << body.error().message;
  EXPECT_NE(body.error().message.find("the first from ("), std::string::npos) << body.error().message;
}

TEST(ImportMannequin, measures_mannequins_that_others_made) {
  const std::string folder = std::string(VITRINE_SOURCE_DIR) + "/../shared/mannequins/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the folder with other people's mannequins is absent";
  // ../shared/mannequins/measurements.tsv, in metres; allowed: girths 10 mm, lengths 15 mm, neck base 25 mm.
  struct Known {
    const char* file;
    double height, bust, under_bust, waist, hip, inside_leg, arm, neck_base;
  };
  const Known known[] = {{"mh_female_average.obj", 1.6297, 0.9281, 0.8019, 0.7679, 1.0107, 0.7644, 0.5296, 0.3714},
                         {"mh_male_average.obj", 1.7552, 1.0164, 0.9739, 0.8578, 1.0099, 0.8265, 0.5901, 0.4405}};
  for (const Known& k : known) {
    const Result<Mannequin> body = import_mannequin(folder + k.file);
    ASSERT_TRUE(body) << body.error().message;
    EXPECT_NEAR(body->girths.at("height"), k.height, 0.001);
    EXPECT_NEAR(body->girths.at("bust"), k.bust, 0.010);
    EXPECT_NEAR(body->girths.at("under_bust"), k.under_bust, 0.010);
    EXPECT_NEAR(body->girths.at("waist"), k.waist, 0.010);
    EXPECT_NEAR(body->girths.at("hip"), k.hip, 0.010);
    EXPECT_NEAR(body->girths.at("inside_leg"), k.inside_leg, 0.015);
    EXPECT_NEAR(body->girths.at("arm"), k.arm, 0.015);
    EXPECT_NEAR(body->girths.at("neck_base"), k.neck_base, 0.025);
    const Result<DistanceField> field = voxelise(body->mesh, {0.008, 0.03});
    ASSERT_TRUE(field);
    for (const char* joint : {"elbow_left", "elbow_right", "wrist_left", "wrist_right", "biceps_left", "knee_right"})
      EXPECT_LT(field->distance(body->landmarks.at(joint)), -0.01) << joint;
    for (const char* skin : {"neck_left", "neck_right", "shoulder_left", "shoulder_right", "waist", "hip", "bust_left"})
      EXPECT_NEAR(field->distance(body->landmarks.at(skin)), 0, 0.005) << skin;
  }
  const Result<Mannequin> human = import_mannequin(folder + "deb_assimp_human.obj");
  ASSERT_TRUE(human) << human.error().message;
  EXPECT_NEAR(human->girths.at("height"), 1.75, 0.01);
}

}  // namespace
}  // namespace vitrine
