/* A PI controller of the rotor speed with the interface of Bladed. Its input file holds the set point [rad/s], both
   gains, and the speeds [rad/s] above which it warns and fails. It asks for record 47 and counts its calls in record
   120. Like any such library it keeps its states to itself. */
#include <stdio.h>

static double set_point, proportional, integral, warns_above, fails_above;
static double sum;
static int calls;

void DISCON(float* swap, int* fail, char* input_file, char* output_name, char* message) {
  const int status = (int)swap[0];
  const double speed = swap[20];
  const int size = (int)swap[48];
  (void)output_name;
  *fail = 0;
  if (status < 0) return;
  if (status == 0) {
    FILE* file = fopen(input_file, "r");
    int read = 0;
    if (file != NULL) {
      read = fscanf(file, "%lf %lf %lf %lf %lf", &set_point, &proportional, &integral, &warns_above, &fails_above);
      fclose(file);
    }
    if (read != 5) {
      *fail = -1;
      snprintf(message, (size_t)size, "cannot read five numbers from '%s'", input_file);
      return;
    }
    sum = 0.0;
    calls = 0;
  }
  const double error = set_point - speed;
  sum += error * swap[2];
  swap[46] = (float)(proportional * error + integral * sum);
  swap[119] = (float)++calls;
  if (speed > fails_above) {
    *fail = -2;
    snprintf(message, (size_t)size, "the rotor runs away at %.2f rad/s", speed);
  } else if (speed > warns_above) {
    *fail = 1;
    snprintf(message, (size_t)size, "the rotor is fast");
  }
}
