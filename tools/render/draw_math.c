#include "render/draw_math.h"

matrix4 matrix4_product(const matrix4 *a, const matrix4 *b) {
  matrix4 product;
  for (int column = 0; column < 4; column++)
    for (int row = 0; row < 4; row++) {
      float sum = 0;
      for (int k = 0; k < 4; k++) sum += a->at[4 * k + row] * b->at[4 * column + k];
      product.at[4 * column + row] = sum;
    }
  return product;
}

matrix4 matrix4_view(sbf_vec3 eye, sbf_vec3 back, sbf_vec3 up) {
  sbf_vec3 right = v3_unit(v3_cross(up, back), v3_side(back));
  sbf_vec3 over = v3_cross(back, right);
  return (matrix4){{right.x, over.x, back.x, 0, right.y, over.y, back.y, 0, right.z, over.z, back.z, 0,
      -v3_dot(right, eye), -v3_dot(over, eye), -v3_dot(back, eye), 1}};
}

matrix4 matrix4_perspective(float half_height, float aspect, float near, float far) {
  float depth = near - far;
  return (matrix4){{1 / (half_height * aspect), 0, 0, 0, 0, 1 / half_height, 0, 0, 0, 0, (near + far) / depth,
      -1, 0, 0, 2 * near * far / depth, 0}};
}

matrix4 matrix4_orthographic(float left, float right, float bottom, float top, float near, float far) {
  return (matrix4){{2 / (right - left), 0, 0, 0, 0, 2 / (top - bottom), 0, 0, 0, 0, 2 / (near - far), 0,
      (left + right) / (left - right), (bottom + top) / (bottom - top), (near + far) / (near - far), 1}};
}
