// The table of directional albedo, shared by C++ and GLSL.
#ifndef CUTIS_SHARED_ALBEDO_TABLE_H
#define CUTIS_SHARED_ALBEDO_TABLE_H

// Values of one row: one roughness. Value i stands for mu = (i / (ALBEDO_ROW_SIZE - 1))².
#define ALBEDO_ROW_SIZE 256

#endif
