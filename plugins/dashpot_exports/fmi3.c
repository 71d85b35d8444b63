/* FMI 3.0 for co-simulation, on a network. */
#include <stdbool.h>
#include <stdint.h>

#include "component.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

typedef enum { OK, WARNING, DISCARD, ERROR, FATAL } status;
typedef void *instance;
typedef uint32_t reference;
typedef void (*callback)(void);

EXPORT const char *fmi3GetVersion(void) { return "3.0"; }

EXPORT status fmi3SetDebugLogging(instance c, bool on, size_t n, const char *const categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return OK;
}

EXPORT instance fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                            bool logging, bool events, bool early, const reference required[], size_t n,
                                            void *environment, callback log, callback intermediate)
{
    (void)name, (void)resources, (void)visible, (void)logging, (void)events, (void)early, (void)required, (void)n;
    (void)environment, (void)log, (void)intermediate;
    return component_new(token);
}

EXPORT instance fmi3InstantiateModelExchange(const char *name, const char *token, const char *resources, bool visible,
                                             bool logging, void *environment, callback log)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment, (void)log;
    return NULL;
}

EXPORT instance fmi3InstantiateScheduledExecution(const char *name, const char *token, const char *resources,
                                                  bool visible, bool logging, void *environment, callback log,
                                                  callback clock, callback lock, callback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment, (void)log;
    (void)clock, (void)lock, (void)unlock;
    return NULL;
}

EXPORT void fmi3FreeInstance(instance c) { free(c); }

EXPORT status fmi3EnterInitializationMode(instance c, bool known, double tolerance, double start, bool ends, double stop)
{
    (void)known, (void)tolerance, (void)ends, (void)stop;
    ((component *)c)->time = start;
    return OK;
}

EXPORT status fmi3ExitInitializationMode(instance c)
{
    component_begin(c);
    return OK;
}

EXPORT status fmi3Terminate(instance c)
{
    (void)c;
    return OK;
}

EXPORT status fmi3Reset(instance c)
{
    component_reset(c);
    return OK;
}

EXPORT status fmi3GetFloat64(instance c, const reference which[], size_t n, double value[], size_t values)
{
    for (size_t k = 0; k < n; ++k) {
        if (k >= values || !component_get(c, which[k], value + k)) {
            return ERROR;
        }
    }
    return OK;
}

EXPORT status fmi3SetFloat64(instance c, const reference which[], size_t n, const double value[], size_t values)
{
    for (size_t k = 0; k < n; ++k) {
        if (k >= values || !component_set(c, which[k], value[k])) {
            return ERROR;
        }
    }
    return OK;
}

EXPORT status fmi3GetInt32(instance c, const reference which[], size_t n, int32_t value[], size_t values)
{
    for (size_t k = 0; k < n; ++k) {
        int found;
        if (k >= values || !component_get_integer(c, which[k], &found)) {
            return ERROR;
        }
        value[k] = found;
    }
    return OK;
}

/* There are no variables of other types. */
#define NONE(name, type)                                                                                               \
    EXPORT status name(instance c, const reference which[], size_t n, type value[], size_t values)                     \
    {                                                                                                                  \
        (void)c, (void)which, (void)value, (void)values;                                                               \
        return n ? ERROR : OK;                                                                                         \
    }
#define NO_SUCH(kind, type) NONE(fmi3Get##kind, type) NONE(fmi3Set##kind, const type)
NO_SUCH(Float32, float)
NO_SUCH(Int8, int8_t)
NO_SUCH(UInt8, uint8_t)
NO_SUCH(Int16, int16_t)
NO_SUCH(UInt16, uint16_t)
NONE(fmi3SetInt32, const int32_t)
NO_SUCH(UInt32, uint32_t)
NO_SUCH(Int64, int64_t)
NO_SUCH(UInt64, uint64_t)
NO_SUCH(Boolean, bool)
NONE(fmi3GetString, const char *)
NONE(fmi3SetString, const char *const)

EXPORT status fmi3GetBinary(instance c, const reference which[], size_t n, size_t sizes[], const uint8_t *value[],
                            size_t values)
{
    (void)c, (void)which, (void)sizes, (void)value, (void)values;
    return n ? ERROR : OK;
}

EXPORT status fmi3SetBinary(instance c, const reference which[], size_t n, const size_t sizes[],
                            const uint8_t *const value[], size_t values)
{
    (void)c, (void)which, (void)sizes, (void)value, (void)values;
    return n ? ERROR : OK;
}

EXPORT status fmi3GetClock(instance c, const reference which[], size_t n, bool value[])
{
    (void)c, (void)which, (void)value;
    return n ? ERROR : OK;
}

EXPORT status fmi3SetClock(instance c, const reference which[], size_t n, const bool value[])
{
    (void)c, (void)which, (void)value;
    return n ? ERROR : OK;
}

EXPORT status fmi3GetFMUState(instance c, void **state)
{
    free(*state);
    *state = component_copy(c);
    return *state ? OK : ERROR;
}

EXPORT status fmi3SetFMUState(instance c, void *state)
{
    memcpy(c, state, sizeof(component));
    return OK;
}

EXPORT status fmi3FreeFMUState(instance c, void **state)
{
    (void)c;
    free(*state);
    *state = NULL;
    return OK;
}

EXPORT status fmi3SerializedFMUStateSize(instance c, void *state, size_t *size)
{
    (void)c, (void)state;
    *size = sizeof(component);
    return OK;
}

EXPORT status fmi3SerializeFMUState(instance c, void *state, uint8_t bytes[], size_t size)
{
    (void)c;
    if (size < sizeof(component)) {
        return ERROR;
    }
    memcpy(bytes, state, sizeof(component));
    return OK;
}

EXPORT status fmi3DeserializeFMUState(instance c, const uint8_t bytes[], size_t size, void **state)
{
    if (size < sizeof(component)) {
        return ERROR;
    }
    if (!*state) {
        *state = component_copy(c);
    }
    memcpy(*state, bytes, sizeof(component));
    return OK;
}

EXPORT status fmi3DoStep(instance c, double now, double step, bool final, bool *event, bool *terminate, bool *early,
                         double *last)
{
    (void)final;
    *event = *terminate = *early = false;
    *last = now;
    if (!(step > 0.0)) {
        return ERROR;
    }
    component_step(c, step);
    ((component *)c)->time = *last = now + step;
    return STATUS(&((component *)c)->network) ? WARNING : OK;
}

/* What an importer may look for and this kind of unit does not have. */
#define ABSENT(name)                                                                                                   \
    EXPORT status name(instance c)                                                                                     \
    {                                                                                                                  \
        (void)c;                                                                                                       \
        return ERROR;                                                                                                  \
    }
ABSENT(fmi3EnterEventMode)
ABSENT(fmi3GetNumberOfVariableDependencies)
ABSENT(fmi3GetVariableDependencies)
ABSENT(fmi3GetDirectionalDerivative)
ABSENT(fmi3GetAdjointDerivative)
ABSENT(fmi3EnterConfigurationMode)
ABSENT(fmi3ExitConfigurationMode)
ABSENT(fmi3GetIntervalDecimal)
ABSENT(fmi3GetIntervalFraction)
ABSENT(fmi3GetShiftDecimal)
ABSENT(fmi3GetShiftFraction)
ABSENT(fmi3SetIntervalDecimal)
ABSENT(fmi3SetIntervalFraction)
ABSENT(fmi3SetShiftDecimal)
ABSENT(fmi3SetShiftFraction)
ABSENT(fmi3EvaluateDiscreteStates)
ABSENT(fmi3UpdateDiscreteStates)
ABSENT(fmi3EnterContinuousTimeMode)
ABSENT(fmi3CompletedIntegratorStep)
ABSENT(fmi3SetTime)
ABSENT(fmi3SetContinuousStates)
ABSENT(fmi3GetContinuousStateDerivatives)
ABSENT(fmi3GetEventIndicators)
ABSENT(fmi3GetContinuousStates)
ABSENT(fmi3GetNominalsOfContinuousStates)
ABSENT(fmi3GetNumberOfEventIndicators)
ABSENT(fmi3GetNumberOfContinuousStates)
ABSENT(fmi3EnterStepMode)
ABSENT(fmi3GetOutputDerivatives)
ABSENT(fmi3ActivateModelPartition)
