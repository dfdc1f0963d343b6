/* SPDX-License-Identifier: MIT */
/*
 * The plugin ABI of Vitrine, version 1.0: plain C, C11 to C++20, depends on nothing.
 *
 * A plugin is a shared library `NAME.vitrine.so` that exports ONE data symbol, `vitrine_plugin_entry`: a table that
 * describes garment types and necklines. It holds no code that the host has to call.
 *
 * Rules, for as long as the major version is 1
 *  1. Fields are only appended, never moved, removed or given another meaning. Every struct is read by
 *     min(size given by the plugin, sizeof in the host); what is missing reads as zero.
 *  2. Only fixed-width integers, double, pointers and spans cross the border. No bool, enum, bit field, long, std type.
 *  3. Strings are UTF-8, end with a zero, and hold no control characters.
 *  4. Everything a plugin points to is static, read-only and initialised at compile time. The host never unloads a
 *     plugin, so a pointer stays good until the process ends. There is no init and no deinit.
 *  5. The host copies and checks the tables once, on one thread, when it adopts the plugin; it keeps no pointer.
 *     A table that breaks a rule fails the whole plugin with a message that names plugin, file and rule.
 *  6. Units are SI (m, kg, s, N) unless a field says otherwise; numbers are finite.
 *  7. Things refer to each other by NAME, so tables can be composed and reordered. A name is unique in its table.
 *
 * The front frame: "left" is the left of the FRONT picture (x < 0, the wearer's right). Back pictures are mirrored when
 * they are loaded, so front and back share one table, and a seam usually joins two edges of the same name.
 */
#ifndef VITRINE_ABI_H
#define VITRINE_ABI_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define VITRINE_MAGIC 0x52544956u /* the bytes "VITR" */
#define VITRINE_ABI_MAJOR 1u
#define VITRINE_ABI_MINOR 0u /* the newest minor that this header describes */

/* The minor version that a plugin asks for. It defaults to the lowest, so that a plugin runs on the most hosts; define
 * it before the include to use fields that a later minor appended. */
#ifndef VITRINE_ABI_TARGET_MINOR
#define VITRINE_ABI_TARGET_MINOR 0u
#endif

#if defined(_WIN32)
#define VITRINE_EXPORT __declspec(dllexport)
#else
#define VITRINE_EXPORT __attribute__((visibility("default")))
#endif

/* A span: `count` elements, `stride` bytes apart (sizeof in the plugin's compile, so that elements can grow).
 * Owner: the plugin, static. Count 0 means empty; then data and stride are not read. */
#define VITRINE_DECLARE_SPAN(type) \
  typedef struct type##_span {     \
    const type* data;              \
    uint32_t count;                \
    uint32_t stride;               \
  } type##_span

/* A name of something else in the tables, or of a body landmark. */
typedef struct vitrine_name {
  const char* name;
} vitrine_name;
VITRINE_DECLARE_SPAN(vitrine_name);

/* Which way the outline turns at a feature when it is walked clockwise in the picture. */
#define VITRINE_TURN_CONCAVE (-1)
#define VITRINE_TURN_ANY 0
#define VITRINE_TURN_CONVEX 1

/* A point of the outline that is looked for in the photo. */
typedef struct vitrine_feature {
  const char* name;     /* [a-z][a-z0-9_]*, unique in the garment, e.g. "armpit_left" */
  const char* landmark; /* body landmark (Table I; list in docs/ABI.md), e.g. "armpit_left"; NULL = none */
  const char* mirror;   /* the partner on the other side; itself when on the middle line; NULL = none */
  int32_t turn;         /* VITRINE_TURN_* */
  uint32_t reserved;    /* 0 */
} vitrine_feature;
VITRINE_DECLARE_SPAN(vitrine_feature);

/* Where a feature lies in one pose. */
typedef struct vitrine_pose_point {
  const char* feature; /* name of a feature */
  double u, v;         /* place in the bounding box of the silhouette: (0,0) top left, (1,1) bottom right */
  double radius;       /* search radius as a share of the box diagonal, (0, 0.5] */
} vitrine_pose_point;
VITRINE_DECLARE_SPAN(vitrine_pose_point);

/* One way in which the garment lies on its board (sleeves down, sleeves spread). The matcher tries every pose. */
typedef struct vitrine_pose {
  const char* name;               /* [a-z][a-z0-9_]* */
  vitrine_pose_point_span points; /* every feature exactly once, any order; the outline they span runs clockwise */
} vitrine_pose;
VITRINE_DECLARE_SPAN(vitrine_pose);

#define VITRINE_EDGE_SEAM 0u /* sewn to an edge of the other or the same panel */
#define VITRINE_EDGE_OPEN 1u /* hem, cuff, armhole, waist: stays open */
#define VITRINE_EDGE_NECK 2u /* open; a neckline shapes it; at most one per garment */

/* A part of the outline. Edges stand in clockwise picture order; each begins where the last one ended, and the last
 * ends where the first began. Features stand in the same clockwise order. */
typedef struct vitrine_edge {
  const char* name;  /* [a-z][a-z0-9_]*, unique in the garment */
  const char* from;  /* feature */
  const char* to;    /* feature */
  uint32_t kind;     /* VITRINE_EDGE_* */
  uint32_t reserved; /* 0 */
} vitrine_edge;
VITRINE_DECLARE_SPAN(vitrine_edge);

#define VITRINE_SIDE_FRONT 0u
#define VITRINE_SIDE_BACK 1u

/* Two edges that are sewn together. Every edge of kind SEAM is in exactly one seam on each side it exists (front and
 * back); edges of other kinds are in none. */
typedef struct vitrine_seam {
  const char* edge_a;
  const char* edge_b;
  uint32_t side_a;   /* VITRINE_SIDE_* */
  uint32_t side_b;   /* VITRINE_SIDE_* */
  uint32_t reversed; /* 0: the edges run in the same direction, partner to partner; 1: one runs against the other */
  uint32_t reserved; /* 0 */
} vitrine_seam;
VITRINE_DECLARE_SPAN(vitrine_seam);

/* A tube that follows a limb of the body: a sleeve, a trouser leg. */
typedef struct vitrine_limb {
  const char* name;   /* [a-z][a-z0-9_]* */
  const char* root_a; /* two features that span the root line, e.g. shoulder_left, armpit_left */
  const char* root_b;
  const char* tip_a; /* two features that span the tip, e.g. cuff_upper_left, cuff_lower_left */
  const char* tip_b;
  vitrine_name_span chain; /* two or more body landmarks from root to tip, e.g. shoulder_left, elbow_left, wrist_left */
} vitrine_limb;
VITRINE_DECLARE_SPAN(vitrine_limb);

/* How large the garment is when the shop gives no measurement: twice the flat distance of two features (front and back)
 * is the body girth times `ease`. */
typedef struct vitrine_scale_rule {
  const char* feature_a; /* the two features whose flat distance the shop lists as chest (or waist) width */
  const char* feature_b;
  const char* girth; /* bust, under_bust, waist, hip, neck_base, biceps, wrist or thigh */
  double ease;       /* [-] garment girth / body girth, [0.3, 4] */
  const char* top;   /* features between which the garment's length is measured (vertical distance) */
  const char* bottom;
} vitrine_scale_rule;
VITRINE_DECLARE_SPAN(vitrine_scale_rule);

/* A sheet material: k and m of the paper's equation (2), as properties of the cloth, so they hold at every mesh size.
 */
typedef struct vitrine_fabric {
  const char* name; /* [a-z][a-z0-9_]*, unique in the garment */
  double stretch;   /* [N/m] tension stiffness of the sheet, [1, 1e7] */
  double shear;     /* [N/m] shear stiffness of the sheet, [0, 1e7] */
  double bend;      /* [N m] bending stiffness (Peirce flexural rigidity per width), [0, 1] */
  double mass;      /* [kg/m^2] [0.01, 5] */
  double friction;  /* [-] Coulomb friction against the body, [0, 5] */
} vitrine_fabric;
VITRINE_DECLARE_SPAN(vitrine_fabric);

/* A garment type. It knows no neckline: it only marks its neck edge. */
typedef struct vitrine_garment {
  const char* id;                /* [a-z][a-z0-9_]*, unique among all loaded plugins, e.g. "vest" */
  const char* title;             /* for people, e.g. "Vest" */
  vitrine_feature_span features; /* 3..64, clockwise in the picture */
  vitrine_pose_span poses;       /* 1..16 */
  vitrine_edge_span edges;       /* 3..64, the same outline for front and back */
  vitrine_seam_span seams;       /* 1..64 */
  vitrine_limb_span limbs;       /* 0..8 */
  vitrine_scale_rule_span scale; /* exactly 1 */
  vitrine_name_span anchors;     /* 1..16 features that hang at the height of their body landmark */
  vitrine_fabric_span fabrics;   /* 1..32; the first is the default */
} vitrine_garment;
VITRINE_DECLARE_SPAN(vitrine_garment);

/* A point of a neckline in the neck edge's own coordinates. */
typedef struct vitrine_profile_point {
  double s;     /* 0 at the edge's first feature, 1 at its last */
  double depth; /* towards the hem, as a share of the neckline's depth: 0 shoulder line, 1 lowest point */
} vitrine_profile_point;
VITRINE_DECLARE_SPAN(vitrine_profile_point);

/* A neckline. It knows no garment: it fits every garment that marks a neck edge. */
typedef struct vitrine_neckline {
  const char* id;                     /* [a-z][a-z0-9_]*, unique among all loaded plugins, e.g. "neck_u" */
  const char* title;                  /* for people, e.g. "U-neck" */
  vitrine_profile_point_span profile; /* 3..256; s strictly ascending from 0 to 1, depth 0 at both ends, 1 somewhere */
  double ratio_min, ratio_max;        /* [-] foreground/background pixels of the neck area that select it: [min, max) */
  double default_depth;               /* [-] usual depth / width, (0, 5]; tells necklines of one ratio apart */
} vitrine_neckline;
VITRINE_DECLARE_SPAN(vitrine_neckline);

/* The descriptor. The first four fields never change in any version: they are read before anything else. */
typedef struct vitrine_plugin {
  uint32_t magic;     /* VITRINE_MAGIC */
  uint32_t abi_major; /* VITRINE_ABI_MAJOR; must equal the host's */
  uint32_t abi_minor; /* VITRINE_ABI_TARGET_MINOR; must not exceed the host's */
  uint32_t size;      /* sizeof(vitrine_plugin) */
  const char* vendor; /* who made it, for people */
  const char* id; /* reverse URI, unique: [a-z0-9_-] parts joined by dots, at least two, e.g. "org.example.poncho" */
  const char* version;             /* of the plugin: MAJOR.MINOR.PATCH, optionally -PRERELEASE and +BUILD (semver 2) */
  vitrine_garment_span garments;   /* 0..64; garments and necklines not both empty */
  vitrine_neckline_span necklines; /* 0..64 */
  /* Later abilities, asked for by id (e.g. "vitrine.locate/1"). Returns a static table or NULL when unknown; must be
   * callable from any thread at any time and must not throw. NULL = the plugin has none. 1.0 hosts never call it. */
  const void* (*extension)(const char* id);
} vitrine_plugin;

/* The one symbol that a plugin exports. Owner: the plugin. Lifetime: the process. Thread: any, it is constant. */
extern VITRINE_EXPORT const vitrine_plugin vitrine_plugin_entry;
#define VITRINE_ENTRY_SYMBOL "vitrine_plugin_entry"

/* The designators that every entry begins with: const vitrine_plugin vitrine_plugin_entry = {VITRINE_HEADER, .vendor =
 * ... */
#define VITRINE_HEADER                                                                           \
  .magic = VITRINE_MAGIC, .abi_major = VITRINE_ABI_MAJOR, .abi_minor = VITRINE_ABI_TARGET_MINOR, \
  .size = (uint32_t)sizeof(vitrine_plugin)

#ifdef __cplusplus
}
#endif

#endif /* VITRINE_ABI_H */
