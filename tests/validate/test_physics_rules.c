#include "rules.h"

#define WITH(attributes) BODY(TETRA "<attributes " attributes "/>")

START_TEST(test_mass)
{
  rules_expect(BODY(SURFACE(TETRA_POINTS, "3 3", "0 2 1 0 1 2")),
      "POINT_UNUSED /sbf/soft_body[1]/polygon_mesh/positions #3\n"
      "POLYGON_REPEATED /sbf/soft_body[1]/polygon_mesh/polygon_sizes #1\nBODY_NO_MASS /sbf/soft_body[1]");
  rules_expect(WITH("density=\"0.5\""), "DENSITY_LOOKS_WRONG /sbf/soft_body[1]/attributes");
  rules_expect("<rigid_bodies><rigid_body id=\"x\" name=\"X\" mass=\"1\" density=\"1e5\"/></rigid_bodies>",
      "DENSITY_LOOKS_WRONG /sbf/rigid_bodies/rigid_body[1]");
}
END_TEST

START_TEST(test_weight)
{
  /* 1000 kg/m^3 * 9.81 m/s^2 * 0.3464 m = 3398 Pa, ten times the body's limit at 340 Pa */
  rules_expect(WITH("young_modulus=\"350\""), "");
  rules_expect(WITH("young_modulus=\"330\""), "BODY_COLLAPSES /sbf/soft_body[1]");
  rules_expect(WITH("young_modulus=\"330\" gravity_scale=\"0.5\""), "");
  rules_expect(WITH("young_modulus=\"330\"") "<environment gravity=\"0 -1.6 0\"/>", "");
}
END_TEST

START_TEST(test_size)
{
#define SIZED(l)                                                                                             \
  "<render_mesh id=\"r\" name=\"R\">" MESH(                                                                  \
      "rendering", "0 0 0 " l " 0 0 0 " l " 0", "3", "0 1 2") "</render_mesh>"
  rules_expect(SIZED("29"), "");
  rules_expect(SIZED("31"), "UNIT_LOOKS_WRONG /sbf");
  rules_expect(SIZED("0.004"), "UNIT_LOOKS_WRONG /sbf");
}
END_TEST

START_TEST(test_poisson)
{
#define RATIO(ratio) BODY(TETRA "<attributes poisson_ratio=\"" ratio "\"/>" TETRA_SPRINGS)
  rules_expect(RATIO("0.44"), "");
  rules_expect(RATIO("0.46"), "POISSON_UNSHOWN /sbf/soft_body[1]/level[1]");
  rules_expect(RATIO("0.04"), "POISSON_UNSHOWN /sbf/soft_body[1]/level[1]");
  /* Once for all of them. */
#define OTHER(id, ratio)                                                                                     \
  "<soft_body id=\"" id "\" name=\"" id "\">" TETRA "<attributes poisson_ratio=\"" ratio                     \
  "\"/>" TETRA_SPRINGS "</soft_body>"
  rules_expect(
      RATIO("0.3") OTHER("c", "0.46") OTHER("d", "0.48"), "POISSON_UNSHOWN /sbf/soft_body[2]/level[1]");
}
END_TEST

START_TEST(test_substeps)
{
  /* two free points of 1 kg on a spring of 5000 N/m: w = sqrt(2 k / m) = 100 rad/s, and a tick of 0.1 s needs
   * more than 0.1 * 100 / 2 = 5 substeps, or as many */
#define STEPPED(scheme, substeps)                                                                            \
  BODY(LEVEL("", "0 0 0 1 0 0",                                                                              \
      "<masses>1 1</masses>" SPRINGS("", "0 1",                                                              \
          "<stiffness>5000</stiffness>") "<simulation scheme=\"" scheme "\" substeps=\"" substeps "\"/>"))   \
  "<environment control_tick=\"0.1\"/>"
  rules_expect(STEPPED("symplectic", "5"), "");
  rules_expect(STEPPED("symplectic", "4"), "SUBSTEPS_TOO_FEW /sbf/soft_body[1]/level[1]");
  rules_expect(STEPPED("symplectic", "0"), ""); /* as many as it needs */
  rules_expect(STEPPED("position_based", "1"), "");
}
END_TEST

START_TEST(test_pressure)
{
  rules_expect(WITH("pressure=\"10\" pressure_mode=\"gas\""), "");
  rules_expect(
      BODY(SURFACE("0 0 0 1 0 0 1 0 1 0 0 1", "4", "0 3 2 1") "<attributes pressure_mode=\"volume\"/>"),
      "PRESSURE_OPEN /sbf/soft_body[1]/attributes");
}
END_TEST

RULES_MAIN("physics_rules", test_mass, test_weight, test_size, test_poisson, test_substeps, test_pressure)
