#pragma once
// Code of the effects as functions of C (write_instant_code.cpp); the last row has no name.

#ifdef __cplusplus
extern "C" {
#endif

struct CodedEffect {
  char const* effect;
  int is_plain;  // the form without shapes
  double (*torque)(double const* parameters, double q, double dq, double ddq, double s, double friction_sign,
                   double load, double baseline_inertia);
};
extern struct CodedEffect const coded_effects[];

#ifdef __cplusplus
}
#endif
