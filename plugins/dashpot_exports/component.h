/* What both versions of the interface share. Variables by number: inputs (displacement and velocity of each driven
   node, then the forces of loaded ones), outputs, the status, what was outside of the range of identification, the
   parameters of the network, the time. The inputs that are set before a step are those of its end. */
#ifndef COMPONENT_H
#define COMPONENT_H

#include <stdlib.h>
#include <string.h>

#include "model.h"

#define FIRST_OUTPUT (2 * DRIVEN + LOADED)
#define STATUS_NUMBER (FIRST_OUTPUT + OUTPUTS)
#define OUTSIDE_NUMBER (STATUS_NUMBER + 1)
#define FIRST_PARAMETER (OUTSIDE_NUMBER + 1)
#define VARIABLES (FIRST_PARAMETER + PARAMETERS)

typedef struct {
    NETWORK network;
    double inputs[FIRST_OUTPUT];
    double outputs[OUTPUTS];
    double time;
    int begun;
} component;

static component *component_new(const char *token)
{
    component *c = strcmp(token, TOKEN) == 0 ? calloc(1, sizeof(component)) : NULL;
    if (c) {
        INIT(&c->network, SPAN);
    }
    return c;
}

static void component_reset(component *c)
{
    memset(c, 0, sizeof(component));
    INIT(&c->network, SPAN);
}

static void component_step(component *c, double step)
{
    double inputs[3 * DRIVEN + LOADED];
    for (int k = 0; k < DRIVEN; ++k) {
        const double *motion = c->inputs + 2 * k;
        inputs[3 * k] = motion[0];
        inputs[3 * k + 1] = motion[1];
        inputs[3 * k + 2] = ACCELERATION(&c->network, k, motion[0], motion[1], step);
    }
    for (int k = 0; k < LOADED; ++k) {
        inputs[3 * DRIVEN + k] = c->inputs[2 * DRIVEN + k];
    }
    ADVANCE(&c->network, inputs, step, c->outputs);
    c->begun = 1;
}

static void component_begin(component *c)
{
    if (!c->begun) {
        component_step(c, STEP);
    }
}

static int component_get(const component *c, unsigned int variable, double *value)
{
    if (variable < FIRST_OUTPUT) {
        *value = c->inputs[variable];
    } else if (variable < STATUS_NUMBER) {
        *value = c->outputs[variable - FIRST_OUTPUT];
    } else if (variable >= FIRST_PARAMETER && variable < VARIABLES) {
        *value = c->network.parameters[variable - FIRST_PARAMETER];
    } else if (variable == VARIABLES) {
        *value = c->time;
    } else {
        return 0;
    }
    return 1;
}

static int component_set(component *c, unsigned int variable, double value)
{
    if (variable < FIRST_OUTPUT) {
        c->inputs[variable] = value;
        return 1;
    }
    if (variable >= FIRST_PARAMETER && variable < VARIABLES) {
        return SET(&c->network, NAMES[variable - FIRST_PARAMETER].name, value);
    }
    return 0;
}

static int component_get_integer(const component *c, unsigned int variable, int *value)
{
    if (variable == STATUS_NUMBER) {
        *value = STATUS(&c->network);
    } else if (variable == OUTSIDE_NUMBER) {
        *value = OUTSIDE(&c->network);
    } else {
        return 0;
    }
    return 1;
}

static void *component_copy(const component *c)
{
    void *copy = malloc(sizeof(component));
    if (copy) {
        memcpy(copy, c, sizeof(component));
    }
    return copy;
}

#endif
