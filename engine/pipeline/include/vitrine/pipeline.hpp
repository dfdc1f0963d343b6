// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vitrine/commerce.hpp"
#include "vitrine/export.hpp"
#include "vitrine/features.hpp"
#include "vitrine/mannequin.hpp"
#include "vitrine/mesh.hpp"
#include "vitrine/model/garment.hpp"
#include "vitrine/panels.hpp"
#include "vitrine/photo.hpp"
#include "vitrine/preview.hpp"
#include "vitrine/sewing.hpp"
#include "vitrine/silhouette.hpp"
#include "vitrine/texture.hpp"

namespace vitrine {

/// How much work one item may cost, as a user asks for it.
enum class Quality { draft, standard, fine };

/// Everything that trades work for accuracy. A quality is one of these with a name; `vitrine measure` varies the rest.
struct Settings {
  std::vector<int> level_nodes;     ///< nodes (both panels) of the mesh levels, coarse to fine
  double residual = 1e-3;           ///< [-] force residual of the last level to stop at
  int max_iterations = 60'000;      ///< per level
  double max_weight_strain = 1e-3;  ///< [-] see SewingOptions: where stiffness is capped; 0 = nowhere
  bool bending = true, friction = true;
  FrontBack front_back = FrontBack::where_crossed;
  bool contact_between_nodes = false;
  bool uncapped_at_rest = false;
  int photo_side = PhotoOptions{}.max_side;  ///< [px] larger photos are reduced to this
};
Settings settings_of(Quality quality);

/// What a user asks of accuracy and time: the cheapest mesh level that meets it is made, none finer than the quality's.
struct Budget {
  /// [node steps/s] One core of a 2.5 GHz Xeon of 2019, see docs/ARCHITECTURE.md; seconds become work by it, once.
  static constexpr double usual_rate = 16e6;
  double max_error = 0;  ///< [m] by the item's own estimate; 0 = none asked
  double max_time = 0;   ///< [s] of a processor, without the mannequin, which items share; 0 = none asked
  double work_rate = usual_rate;
  bool asked() const { return max_error > 0 || max_time > 0; }
};

/// What became of it.
struct BudgetFigures {
  double work = 0, allowed_work = 0;  ///< [node steps] all rooms
  double spent_s = 0;                 ///< [s] the work at the budget's rate
  bool error_met = true, time_met = true;
  std::string ended_by;  ///< error, time or quality (there is no finer mesh)
};

/// A mannequin with its voxels, made once and shared by every item that is dressed on it.
struct Body {
  Mannequin mannequin;
  DistanceField field;
};

/// What the user says the photos show.
struct GarmentChoice {
  GarmentTemplate garment;
  std::vector<NecklineTemplate> necklines;
  std::string neckline = "auto";
  /// Loaded garments: a photo that one of them fits clearly better is refused, and that one is named.
  std::vector<GarmentTemplate> others;
};

/// One photo to be looked at.
struct ViewRequest : GarmentChoice {
  std::string photo;  ///< file
  std::string mask;   ///< file; may be empty
  Side side = Side::front;
  int max_side = PhotoOptions{}.max_side;  ///< [px] a larger photo is reduced to this
};

/// One photo after the rooms photo, silhouette and features; everything in the front frame.
struct View {
  Photo photo;
  Silhouette silhouette;
  Features features;
  std::optional<Error> error;                 ///< set when a room refused; what the rooms before it left is kept
  std::vector<std::string> warnings() const;  ///< of all three rooms, each once
};

/// The first three rooms for one photo. convert() sends each of its photos through the same steps.
View see(const ViewRequest& request);

/// A point as a person with the photo before them calls it: pixels of the photo as given (upright by EXIF, before any
/// reduction; pixel centres at whole numbers), left and right as in that picture.
struct NamedPoint {
  std::string name, landmark;
  Vec2 pixel;
  std::string origin;  ///< FeaturePoint::origin, or "outline": lowest point of an opening without a neckline
  double confidence = 0;
};
constexpr double low_confidence = 0.5;  ///< below: the point was not seen, the template placed it

/// The view's feature points and the lowest point of its top opening (neck_low, waist_low).
std::vector<NamedPoint> points_as_given(const ViewRequest& request, const View& view);

/// Label values in the photo's size as given; empty when no silhouette was found.
Image mask_as_given(const View& view);

/// All that was seen, as JSON; in the photo as given. `view.error` is the refusal.
std::string view_json(const ViewRequest& request, const View& view);
/// The same for people, a few lines of text.
std::string view_table(const ViewRequest& request, const View& view);

enum class PictureFormat { webp, jpeg, png };

/// Pictures of the dressed mannequin besides preview.png, all from one camera that depends on the body alone.
struct PictureRequest {
  std::vector<std::string> views;  ///< of view_names
  int turntable = 0;               ///< views of a turntable, side by side in one file; 0 = none
  int width = 800, height = 1000;  ///< [px] of a view; a turntable's are half as large
  PictureFormat format = PictureFormat::webp;
  Ground ground = Ground::studio;
};
constexpr const char* view_names[] = {"front", "three-quarter", "back", "detail"};

struct ConvertRequest : GarmentChoice {
  std::string name = "garment";  ///< SKU or any label; goes into the names of nodes and into asset extras
  std::string front, back;       ///< photo files; back may be empty with mirror_back
  std::string front_mask, back_mask;
  bool mirror_back = false;            ///< make the back panel from the front photo's silhouette
  std::string fabric;                  ///< name of one of the garment's fabrics; empty = its first
  double spring_k = 0, node_mass = 0;  ///< [N/m], [kg] the paper's own constants, see SewingOptions; 0 = the fabric's
  double chest = 0, length = 0;        ///< [m] flat measurements as the shop lists them; 0 = unknown
  Quality quality = Quality::standard;
  std::optional<Settings> settings;  ///< in place of the quality's
  Budget budget;
  bool debug_images = false;
  std::vector<MeshFormat> formats;  ///< also write the garment as these
  bool compress = false;            ///< also write copies for a web page
  bool thumbnail = false;           ///< also write thumb.jpg, a small copy of preview.png
  /// report.json ends with processor times, the one thing in it that differs from run to run.
  bool times_in_report = true;
  TextureOptions texture;
  PictureRequest pictures;
  std::string copyright;  ///< of the GLBs; may be empty
  std::shared_ptr<const Body> body;
  std::string version;                                                   ///< of the program, for the report
  std::function<void(const std::string& stage, double share)> progress;  ///< may be empty; share in 0..1
};

/// A picture to be written beside the models.
struct NamedFile {
  std::string name;
  Bytes bytes;
};

/// What every room left behind for one item; `error` is set when a room refused, and later rooms are then empty.
struct Conversion {
  std::optional<Error> error;
  View front, back;
  Panels panels;
  Pattern pattern;  ///< of the finest level that was sewn
  Fabric fabric;
  Drape drape;
  BudgetFigures budget;                 ///< when one was asked for
  std::vector<TextureFigures> texture;  ///< front, back
  RenderMesh garment, mannequin;
  Bytes garment_glb, dressed_glb, preview_png;
  Bytes garment_page, dressed_page;  ///< compressed copies, when asked for
  std::vector<CommerceFinding> garment_check, dressed_check;
  Bytes thumbnail;                  ///< JPEG, when asked for
  std::vector<NamedFile> pictures;  ///< as asked for in the request
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, double>> stage_ms;  ///< [ms] of processor time per room, in order
  int exit_code() const { return error ? error->exit_code() : 0; }
};

/// What convert() asks of one of its photos.
ViewRequest view_of(const ConvertRequest& request, Side side);

/// One garment, from two photos to files in memory: the rooms in their order.
Conversion convert(const ConvertRequest& request);

/// convert() in two halves, for one garment on several mannequins. What is seen in the photos does not depend on
/// request.body; panels do, whose size and widths follow the body where the shop lists none.
Conversion see_photos(const ConvertRequest& request);
Conversion dress(Conversion seen, const ConvertRequest& request);

/// A small JPEG of a picture, at most 320x220 px, for lists.
Result<Bytes> thumbnail_of(const Image& picture);

/// The rooms as far as the mesh: the pattern as it lies on the table, nothing placed or sewn.
Conversion cut_and_mesh(const ConvertRequest& request);

/// The rooms as far as the cloth at rest: no texture, files or pictures.
Conversion cut_and_sew(const ConvertRequest& request);

/// What became of one fabric on a pattern that was cut, meshed and placed before.
struct FabricDrape {
  std::string fabric;
  Drape drape;
  std::optional<Error> error;
};

/// The rooms as far as the cloth at rest, the ones before the fabric entered once for all of the garment's fabrics, or
/// for the first `most` of them. `item` is left as cut_and_mesh() leaves it; its error, when a room refused, means that
/// nothing was sewn.
std::vector<FabricDrape> cut_and_sew_fabrics(const ConvertRequest& request, std::size_t most, Conversion& item);

/// report.json: status, reason, features in pixels of the photos as given, mesh, drape and texture figures, how the
/// files stand to the limits of shops ("commerce"), milliseconds per room.
std::string report_json(const ConvertRequest& request, const Conversion& conversion);

/// What was asked of accuracy and time and what became of it, a JSON object; empty when nothing was asked or sewn.
std::string budget_json(const ConvertRequest& request, const Conversion& conversion);

/// Milliseconds of processor time per room, a JSON object.
std::string stage_ms_json(const Conversion& conversion);

/// SHA-256 [hex] of what the report says of the conversion: its compact JSON without "status", "error", "commerce" and
/// "ms", which are not known yet when the models are written. The models carry it in asset.extras.
std::string report_hash(const ConvertRequest& request, const Conversion& conversion);

/// Writes garment.glb, dressed.glb, preview.png, report.json (and debug-*.png, other formats and pictures when asked)
/// into `folder`, each by rename. A refused item writes report.json and the debug pictures it got to.
std::optional<Error> write_conversion(const ConvertRequest& request, const Conversion& conversion,
                                      const std::string& folder);

/// A picture for people: the photo as given with silhouette outline, inside of the back tinted, feature points by name.
/// Small photos are enlarged, and a caption is added below. Empty when there is no silhouette to show.
Image draw_view(const ViewRequest& request, const View& view);
/// The same with the template that was matched on top (the first pose where none was): its edges, points (crosses) and
/// search circles in the silhouette's box, for whoever writes one.
Image draw_template(const ViewRequest& request, const View& view);
Image draw_mesh(const PanelMesh& mesh, int height = 900);

}  // namespace vitrine
