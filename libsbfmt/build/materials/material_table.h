// clang-format off
/* Made from spec/sbf.materials by spec/generate/generate.py: change that, not this file. */
#ifndef SBFI_MATERIAL_TABLE_H
#define SBFI_MATERIAL_TABLE_H

#include "sbfmt/materials.h"

static const sbf_material_preset presets[] = {
  {"cotton", true, 500, 1e7f, 0.3f, 0.1f, 0.5f, 0.15f, 0.0003f, 7e-6f, "Shirting, an estimate: 150 g/m^2 and 0.3 mm are typical of plain weaves, 0.07 gf cm^2/cm of their bending; the modulus is that of the first few per cent of stretch, of an order of 1 to 30 MPa."},
  {"denim", true, 400, 1.5e7f, 0.25f, 0.15f, 0.6f, 0.4f, 0.001f, 1.7e-5f, "Bending 0.14 to 0.23 gf cm^2/cm and thickness 0.8 to 1.2 mm of six denims: J. Textiles 2016, 4614168, table 5. 400 g/m^2 is trade's 12 oz; modulus and friction are an estimate."},
  {"fat", false, 920, 4000, 0.48f, 0.3f, 0.6f, 0, 0.001f, 0, "Shear modulus 0.75 kPa in vivo at rest, rising with strain (human adipose tissue, magnetic resonance elastography: J. Mech. Behav. Biomed. Mater. 2023); indentation of breast tissue gives 3 to 9 kPa. Density 0.92: Kaye and Laby."},
  {"flesh", false, 1050, 20000, 0.48f, 0.25f, 0.6f, 0, 0.001f, 0, "An estimate: muscle under fat and skin, pressed from outside. Gluteal subcutaneous tissue under a light load, 26 kPa: Isogai et al., J. Phys. Ther. Sci. 34, 2022."},
  {"jelly", false, 1020, 3000, 0.48f, 0.06f, 0.3f, 0, 0.001f, 0, "A dessert that stands and shakes, an estimate: a standard pectin gel has a shear modulus of 0.4 kPa (Nielsen, Marr, Hvidt, Carbohydrate Polymers 45, 2001), gelatine jellies some 1 kPa."},
  {"leather", true, 860, 2e7f, 0.35f, 0.2f, 0.5f, 1.03f, 0.0012f, 4e-4f, "Garment leather, an estimate: 1.2 mm, 860 kg/m^3 of textbook tables for dry hide; small-strain moduli of tanned hides are of the order of 10 to 100 MPa, its bending between cloth and plate."},
  {"muscle", false, 1060, 30000, 0.48f, 0.2f, 0.6f, 0, 0.001f, 0, "Density 1.06: Mendez and Keys, Metabolism 9, 1960. Relaxed muscle, 11 +- 4 kPa by shear waves (calf: Arda et al., Am. J. Roentgenol. 197, 2011), 62 +- 10 kPa pressed (gluteal: Isogai et al. 2022); between the two."},
  {"rubber", false, 930, 1.2e6f, 0.48f, 0.05f, 0.9f, 0, 0.001f, 0, "Soft unfilled vulcanised natural rubber: shear modulus 0.4 MPa, of the order that Treloar, The Physics of Rubber Elasticity, finds; its Poisson ratio is 0.4999 and is cut here."},
  {"silk", true, 400, 1.5e7f, 0.3f, 0.08f, 0.3f, 0.06f, 0.00015f, 2e-6f, "Habotai or charmeuse, an estimate: 60 g/m^2 (14 momme) and 0.15 mm are typical, as is a bending of 0.02 gf cm^2/cm; its warp is stiff and its surface smooth."},
};

#endif
