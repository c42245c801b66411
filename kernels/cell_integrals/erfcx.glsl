// SPDX-License-Identifier: Apache-2.0
// C++ and GLSL: exp(x^2) erfc(x) / 2 for 0 <= x <= kFarthest is p(t) / (2 x + 1), t = (x - 2) /
// (x + 2), with a relative error of 1.3e-8 before rounding; p is a polynomial with these
// coefficients, highest first.
const int kErfcxTerms = 10;
const float kErfcx[kErfcxTerms] = {
    -2.071963172e-04f, -6.254414709e-04f, 6.597990050e-04f,  4.324845240e-03f,  -4.029633391e-03f,
    -2.710463746e-02f, 8.202748382e-02f,  -8.301548555e-02f, -4.638198070e-02f, 6.384891934e-01f};
const float kFarthest = 9.4f;  // beyond it e^-x^2 is nothing
