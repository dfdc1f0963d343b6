// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>

namespace vitrine {

/// Foreground of a picture by colour: a mixture that knows where on the board each ground colour lives, a mixture for
/// the garment, and a minimum cut between them, repeated (after Rother et al., GrabCut, 2004). CV_8U, 0 or 255; all 0
/// when nothing differs from the ground. `rgb` should have 300 to 600 px.
/// `ground_like` receives the pixels whose colour speaks clearly for the ground.
cv::Mat cut_by_colour(const cv::Mat& rgb, cv::Mat& ground_like);

}  // namespace vitrine
