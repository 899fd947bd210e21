/* A body on two legs, bent a little at the knee, for rules about motion. */
#ifndef TEST_LEGS_H
#define TEST_LEGS_H

#include "rules.h"

#define LEGS                                                                                                 \
  "<skeleton>" BONE("body", "0 0.5 0", "length=\"0.2\"") BONE("left", "0.1 0.5 0", "parent=\"body\"")        \
      BONE("left_shin", "0.1 0.25 0.05", "parent=\"left\"")                                                  \
          BONE("left_foot", "0.1 0 0", "parent=\"left_shin\"")                                               \
              BONE("right", "-0.1 0.5 0", "parent=\"body\"")                                                 \
                  BONE("right_shin", "-0.1 0.25 0.05", "parent=\"right\"")                                   \
                      BONE("right_foot", "-0.1 0 0", "parent=\"right_shin\"") "</skeleton>"
#define IK(inside) "<ik>" inside "</ik>"
#define CHAIN(id, attributes, inside) "<ik_chain id=\"" id "\" " attributes ">" inside "</ik_chain>"
#define LEFT_IK CHAIN("ik_left", "root=\"left\" end=\"left_foot\"", "")
#define RIGHT_IK CHAIN("ik_right", "root=\"right\" end=\"right_foot\"", "")
#define LEFT_LEG "<leg name=\"Left\" ik=\"ik_left\" home=\"0.1 0 0\"/>"
#define RIGHT_LEG "<leg name=\"Right\" ik=\"ik_right\" home=\"-0.1 0 0\" group=\"1\"/>"
#define GAIT(attributes, inside) "<gait id=\"walk\" body=\"body\" " attributes ">" inside "</gait>"

#endif
