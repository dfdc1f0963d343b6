// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace vitrine {

/// The piece that is the garment: the largest connected one, where pieces near the middle count more.
/// `second` receives the area of the next largest compact piece as a share of it.
cv::Mat main_piece(const cv::Mat& mask, double* second = nullptr);

/// The largest connected piece by area alone: what to keep where nothing but specks can have come loose.
cv::Mat without_specks(const cv::Mat& mask);

/// Takes off what is thin and hangs on by one end only: hooks, cables, threads, tag strings. Straps stay, for they are
/// held at both ends or are wider than `radius` on both sides.
cv::Mat without_loose_ends(const cv::Mat& mask, int radius);

/// Fills what is enclosed by the garment, except openings: enclosed regions that look like the ground and lie close to
/// the outside (between sleeve and body, inside a strap). A print in the ground's colour lies deep inside and is
/// filled. `ground_like` CV_8U: pixels that look like the ground around them.
cv::Mat fill_enclosed(const cv::Mat& mask, const cv::Mat& ground_like);

}  // namespace vitrine
