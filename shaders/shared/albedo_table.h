// The tables of skin's specular layer, shared by C++ and GLSL.
#ifndef CUTIS_SHARED_ALBEDO_TABLE_H
#define CUTIS_SHARED_ALBEDO_TABLE_H

// Directional albedo of one roughness: value i stands for mu = (i / (ALBEDO_ROW_SIZE - 1))².
#define ALBEDO_ROW_SIZE 256

// The specular lobe of one roughness as a sum of smaller ones: for each of LOBE_ROWS values of mu, (j / (LOBE_ROWS - 1))²,
// first the lobes in the plane of incidence, then those that come in mirrored pairs; each is direction (3), sigma, weight.
#define LOBE_ROWS 16
#define LOBES_IN_PLANE 4
#define LOBE_PAIRS 6
#define LOBE_FLOATS 5
#define LOBE_ROW_SIZE ((LOBES_IN_PLANE + LOBE_PAIRS) * LOBE_FLOATS)

// All of one roughness: its directional albedo, then its lobes.
#define SKIN_TABLE_STRIDE (ALBEDO_ROW_SIZE + LOBE_ROWS * LOBE_ROW_SIZE)

#endif
