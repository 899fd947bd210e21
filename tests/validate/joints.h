/* Two rigid bodies, one above the other, and a joint between them. */
#ifndef TEST_JOINTS_H
#define TEST_JOINTS_H

#include "rules.h"

#define TWO_BODIES                                                                                           \
  "<rigid_bodies><rigid_body id=\"up\" name=\"Up\" mass=\"1\" center=\"0 0.3 0\"/>"                          \
  "<rigid_body id=\"low\" name=\"Low\" motion=\"dynamic\" mass=\"1\" center=\"0 0.1 0\"/></rigid_bodies>"
#define JOINT(kind, attributes, frame_a, frame_b, inside)                                                    \
  TWO_BODIES "<joints><" kind "_joint id=\"j\" body_b=\"low\" " attributes "><frame_a " frame_a              \
             "/><frame_b " frame_b "/>" inside "</" kind "_joint></joints>"
#define MEET_A "position=\"0 -0.1 0\""
#define MEET_B "position=\"0 0.1 0\""
#define HINGE(kind, inside) JOINT(kind, "body_a=\"up\"", MEET_A, MEET_B, inside)
#define LIMIT(target, min, max)                                                                              \
  "<limits><limit target=\"" target "\" min=\"" min "\" max=\"" max "\"/></limits>"

#endif
