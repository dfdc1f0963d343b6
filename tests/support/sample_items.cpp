// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_items.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

PhotoSpec sailor_vest() {
  PhotoSpec s;
  s.seed = 11;
  s.neck_depth = 14;
  s.fabric = Fabric2d::stripes;
  s.colour = {240, 233, 217};
  s.second = {44, 84, 156};
  s.trim = {44, 84, 156};
  s.pattern = 2.5;
  s.board = {50, 49, 50};
  s.tilt = 1.2;
  return s;
}

PhotoSpec terracotta_vest() {
  PhotoSpec s;
  s.seed = 23;
  s.neck = NeckKind::v;
  s.neck_half = 9;
  s.neck_depth = 19;
  s.shoulder_half = 15.5;
  s.chest = 46.5;
  s.hem = 46;
  s.length = 58;
  s.colour = {186, 96, 68};
  s.trim = {164, 80, 56};
  s.rib = 2;
  s.hem_rib = 4.5;
  s.board = {232, 227, 219};
  s.tilt = -0.8;
  return s;
}

PhotoSpec prism_long_sleeve() {
  PhotoSpec s;
  s.garment = GarmentKind::long_sleeve;
  s.seed = 37;
  s.neck_half = 9;
  s.neck_depth = 9;
  s.shoulder_half = 21;
  s.shoulder_drop = 3.8;
  s.armhole_depth = 24;
  s.chest = 49;
  s.hem = 48.5;
  s.length = 64;
  s.sleeve_angle = 33;
  s.sleeve_length = 61;
  s.colour = {36, 46, 84};
  s.second = {242, 240, 234};
  s.trim = {31, 40, 74};
  s.motif = true;
  s.creases = 1.35;
  s.width = 1200;
  s.height = 820;
  s.fill = 0.9;
  s.board = {226, 226, 225};
  s.tilt = 0.7;
  return s;
}

PhotoSpec mustard_long_sleeve() {
  PhotoSpec s = prism_long_sleeve();
  s.seed = 41;
  s.neck = NeckKind::square;
  s.neck_half = 10;
  s.neck_depth = 10.5;
  s.motif = false;
  s.chest = 50;
  s.hem = 47;
  s.length = 60;
  s.sleeve_angle = 33;
  s.sleeve_width = 18;
  s.cuff_width = 10;
  s.fabric = Fabric2d::heather;
  s.colour = {210, 150, 44};
  s.second = {240, 208, 130};
  s.trim = {204, 142, 38};
  s.rib = 2.2;
  s.hem_rib = 5.5;
  s.creases = 1.1;
  s.board = {52, 56, 62};
  s.tilt = -1.1;
  return s;
}

PhotoSpec denim_skirt() {
  PhotoSpec s;
  s.garment = GarmentKind::skirt;
  s.seed = 53;
  s.chest = 34.5;
  s.hip = 44;
  s.hip_depth = 19;
  s.hem = 46;
  s.length = 42;
  s.hem_curve = 0.5;
  s.fabric = Fabric2d::denim;
  s.colour = {60, 88, 134};
  s.second = {142, 170, 204};
  s.trim = {58, 84, 128};
  s.creases = 0.8;
  s.width = 960;
  s.height = 900;
  s.fill = 0.82;
  s.board = {234, 230, 223};
  s.tilt = 0.5;
  return s;
}

PhotoSpec floral_skirt() {
  PhotoSpec s;
  s.garment = GarmentKind::skirt;
  s.seed = 67;
  s.chest = 34.5;
  s.hip = 48;
  s.hem = 78;
  s.length = 66;
  s.hem_curve = 4.5;
  s.waistband = 3.2;
  s.gathers = 0.9;
  s.creases = 0.7;
  s.fabric = Fabric2d::floral;
  s.colour = {206, 124, 126};
  s.second = {250, 240, 226};
  s.third = {136, 150, 104};
  s.trim = {200, 114, 118};
  s.pattern = 4.4;
  s.width = 1040;
  s.height = 980;
  s.board = {46, 48, 52};
  s.tilt = -0.6;
  return s;
}

PhotoSpec dotted_t_shirt() {
  PhotoSpec s;
  s.garment = GarmentKind::t_shirt;
  s.seed = 71;
  s.neck_half = 9;
  s.neck_depth = 10;
  s.shoulder_half = 20.5;
  s.shoulder_drop = 3.6;
  s.armhole_depth = 23.5;
  s.chest = 48;
  s.hem = 48;
  s.length = 62;
  s.waist_share = 0.96;
  s.sleeve_length = 20;
  s.sleeve_angle = 43;
  s.sleeve_width = 18;
  s.cuff_width = 15.5;
  s.fabric = Fabric2d::dots;
  s.colour = {30, 98, 102};
  s.second = {244, 238, 222};
  s.trim = {24, 84, 90};
  s.pattern = 3;
  s.rib = 1.8;
  s.width = 1040;
  s.height = 980;
  s.board = {228, 225, 219};
  s.tilt = 0.8;
  return s;
}

PhotoSpec meadow_dress() {
  PhotoSpec s;
  s.garment = GarmentKind::dress;
  s.seed = 83;
  s.neck = NeckKind::v;
  s.neck_half = 9;
  s.neck_depth = 15;
  s.shoulder_half = 15.5;
  s.shoulder_drop = 2;
  s.armhole_depth = 21;
  s.chest = 45;
  s.length = 100;
  s.waist_level = 18.0 / (100 - 21);
  s.waist_share = 0.87;
  s.hip = 49;
  s.hip_depth = 20;
  s.hem = 72;
  s.hem_curve = 1.4;
  s.fabric = Fabric2d::floral;
  s.colour = {42, 54, 98};
  s.second = {246, 214, 150};
  s.third = {106, 150, 120};
  s.trim = {36, 46, 86};
  s.pattern = 5.2;
  s.rib = 1.2;
  s.width = 960;
  s.height = 1200;
  s.board = {231, 226, 218};
  s.tilt = -0.7;
  return s;
}

PhotoSpec indigo_jeans() {
  PhotoSpec s;
  s.garment = GarmentKind::trousers;
  s.seed = 97;
  s.chest = 36;
  s.hip = 46;
  s.hip_depth = 20;
  s.rise = 27;
  s.hem = 20.5;
  s.length = 99;
  s.leg_angle = 3.5;
  s.fabric = Fabric2d::denim;
  s.colour = {38, 56, 96};
  s.second = {112, 142, 184};
  s.trim = {36, 52, 90};
  s.creases = 0.9;
  s.width = 900;
  s.height = 1200;
  s.fill = 0.9;
  s.board = {233, 229, 222};
  s.tilt = 0.6;
  return s;
}

PhotoSpec olive_shorts() {
  PhotoSpec s;
  s.garment = GarmentKind::shorts;
  s.seed = 101;
  s.chest = 36;
  s.hip = 47;
  s.hip_depth = 20;
  s.rise = 28;
  s.hem = 26;
  s.length = 42;
  s.leg_angle = 5;
  s.colour = {118, 118, 72};
  s.trim = {106, 106, 64};
  s.creases = 0.9;
  s.width = 960;
  s.height = 900;
  s.fill = 0.82;
  s.board = {234, 230, 224};
  s.tilt = -0.9;
  return s;
}

}  // namespace

const std::vector<SampleItem>& sample_items() {
  static const std::vector<SampleItem> items{
      {"vest-sailor", "auto", "", "Sailor vest, cream and marine stripes", sailor_vest()},
      {"vest-terracotta", "auto", "", "Ribbed V-neck vest, terracotta", terracotta_vest()},
      {"long-sleeve-sunrise", "auto", "", "Long-sleeved top with sunrise print, navy", prism_long_sleeve()},
      {"long-sleeve-mustard", "auto", "", "Square-neck sweatshirt, mustard melange", mustard_long_sleeve()},
      {"skirt-denim", "auto", "", "Denim mini skirt, washed blue", denim_skirt()},
      {"skirt-garden", "auto", "", "Flared midi skirt with garden print, \"Rosa\"", floral_skirt()},
      {"t-shirt-dots", "auto", "", "Dotted T-shirt, petrol", dotted_t_shirt()},
      {"dress-meadow", "auto", "", "A-line dress with meadow print, ink blue", meadow_dress()},
      {"trousers-indigo", "auto", "", "Straight jeans, indigo", indigo_jeans()},
      {"shorts-olive", "auto", "", "Chino shorts, olive", olive_shorts()},
  };
  return items;
}

std::string sample_manifest() {
  std::string text =
      "sku,garment,neckline,front,back,mirror_back,front_mask,back_mask,chest_cm,length_cm,fabric,title\n";
  for (const SampleItem& item : sample_items()) {
    std::string title;
    for (const char c : item.title) title += c == '"' ? std::string("\"\"") : std::string(1, c);
    // What a shop's tape would say of the garment as it lies: to half a centimetre, between the points that the garment
    // types measure.
    const auto points = make_shape(item.front).landmarks;
    const bool hangs = has_waist(item.front.garment);
    const auto width = [&](const std::string& point) {
      return (points.at(point + "_right") - points.at(point + "_left")).norm();
    };
    const auto number = [](double cm) {
      const long halves = std::lround(2 * cm);
      return std::to_string(halves / 2) + (halves % 2 != 0 ? ".5" : "");
    };
    const double chest = width(hangs ? "waist" : "armpit");
    const double length = points.at(has_legs(item.front.garment) ? "hem_outer_left" : "hem_left").y() -
                          points.at(hangs ? "waist_left" : "neck_left").y();
    text += item.sku + "," + id_of(item.front.garment) + "," + item.neckline + "," + item.sku + "-front.jpg," +
            item.sku + "-back.jpg,,,," + number(chest) + "," + number(length) + "," + item.fabric + ",\"" + title +
            "\"\n";
  }
  return text;
}

std::vector<std::uint8_t> to_jpeg(const Image& rgb, int quality) {
  const cv::Mat view(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.data.data()));
  cv::Mat bgr;
  cv::cvtColor(view, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> file;
  if (!cv::imencode(".jpg", bgr, file, {cv::IMWRITE_JPEG_QUALITY, quality}))
    throw std::runtime_error("JPEG encoder failed");
  return file;
}

}  // namespace vitrine::support
