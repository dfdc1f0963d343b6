// SPDX-License-Identifier: GPL-3.0-or-later
#include "envelope.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine {
namespace {

/// One pass of a window filter along rows (step 1) or columns (step = columns): the window's maximum or mean.
template <class Combine>
void filter_lines(std::vector<double>& grid, int columns, int rows, int radius, bool along_rows, Combine combine) {
  const int lines = along_rows ? rows : columns, length = along_rows ? columns : rows;
  const int step = along_rows ? 1 : columns, jump = along_rows ? columns : 1;
  std::vector<double> line(static_cast<std::size_t>(length));
  for (int l = 0; l < lines; ++l) {
    double* base = grid.data() + l * jump;
    for (int i = 0; i < length; ++i) line[i] = base[i * step];
    for (int i = 0; i < length; ++i)
      base[i * step] = combine(&line[std::max(0, i - radius)], &line[std::min(length - 1, i + radius)] + 1);
  }
}

double largest(const double* first, const double* last) {
  return *std::max_element(first, last);
}
double mean(const double* first, const double* last) {
  double sum = 0;
  for (const double* p = first; p != last; ++p) sum += *p;
  return sum / static_cast<double>(last - first);
}

}  // namespace

Envelope::Envelope(const DistanceField& field, int direction, double cell, double reach) : cell_(cell) {
  origin_ = field.origin.head<2>();
  columns_ = std::max(2, static_cast<int>((field.size[0] - 1) * field.spacing / cell) + 1);
  rows_ = std::max(2, static_cast<int>((field.size[1] - 1) * field.spacing / cell) + 1);
  height_.assign(static_cast<std::size_t>(columns_) * rows_, -1e3);
  // Heights are kept as "outwards", so that one maximum serves both sides.
  for (int iy = 0; iy < rows_; ++iy)
    for (int ix = 0; ix < columns_; ++ix) {
      const double x = origin_.x() + ix * cell, y = origin_.y() + iy * cell;
      for (int k = 0; k < field.size[2];) {
        const int iz = direction > 0 ? field.size[2] - 1 - k : k;
        const double z = field.origin.z() + iz * field.spacing;
        const double free = field.distance(Vec3(x, y, z));
        if (free <= 0) {
          height_[static_cast<std::size_t>(iy) * columns_ + ix] = direction * z;
          break;
        }
        // No surface is nearer than the distance, save what interpolation rounds off.
        k += std::max(1, static_cast<int>(free / field.spacing) - 1);
      }
    }
  const int radius = std::max(1, static_cast<int>(std::lround(reach / cell)));
  // Cells off the body take over from their neighbours until the sheet covers the grid.
  for (int round = 0; round < std::max(columns_, rows_) / radius + 2; ++round) {
    std::vector<double> grown = height_;
    filter_lines(grown, columns_, rows_, radius, true, largest);
    filter_lines(grown, columns_, rows_, radius, false, largest);
    if (round == 0) {
      height_ = grown;
      continue;
    }
    bool open = false;
    for (std::size_t i = 0; i < height_.size(); ++i)
      if (height_[i] < -1e2) {
        height_[i] = grown[i];
        open = open || grown[i] < -1e2;
      }
    if (!open) break;
  }
  // The mean over a window no wider than the maximum's never sinks below the body.
  filter_lines(height_, columns_, rows_, radius / 2, true, mean);
  filter_lines(height_, columns_, rows_, radius / 2, false, mean);
  for (double& h : height_) h *= direction;
}

double Envelope::at(int ix, int iy) const {
  ix = std::clamp(ix, 0, columns_ - 1);
  iy = std::clamp(iy, 0, rows_ - 1);
  return height_[static_cast<std::size_t>(iy) * columns_ + ix];
}

double Envelope::operator()(double x, double y) const {
  const double u = std::clamp((x - origin_.x()) / cell_, 0.0, static_cast<double>(columns_ - 1));
  const double v = std::clamp((y - origin_.y()) / cell_, 0.0, static_cast<double>(rows_ - 1));
  const int ix = static_cast<int>(u), iy = static_cast<int>(v);
  const double a = u - ix, b = v - iy;
  return (1 - a) * (1 - b) * at(ix, iy) + a * (1 - b) * at(ix + 1, iy) + (1 - a) * b * at(ix, iy + 1) +
         a * b * at(ix + 1, iy + 1);
}

}  // namespace vitrine
