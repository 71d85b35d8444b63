/* FMI 2.0 for co-simulation, on a network. */
#include "component.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

typedef enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING } status;
typedef void *instance;
typedef unsigned int reference;
typedef struct {
    void (*logger)(void);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, status);
    void *environment;
} callbacks;

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }

EXPORT status fmi2SetDebugLogging(instance c, int on, size_t n, const char *const categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return OK;
}

EXPORT instance fmi2Instantiate(const char *name, int type, const char *token, const char *resources,
                                const callbacks *functions, int visible, int logging)
{
    (void)name, (void)resources, (void)functions, (void)visible, (void)logging;
    return type == 1 ? component_new(token) : NULL;
}

EXPORT void fmi2FreeInstance(instance c) { free(c); }

EXPORT status fmi2SetupExperiment(instance c, int known, double tolerance, double start, int ends, double stop)
{
    (void)known, (void)tolerance, (void)ends, (void)stop;
    ((component *)c)->time = start;
    return OK;
}

EXPORT status fmi2EnterInitializationMode(instance c)
{
    (void)c;
    return OK;
}

EXPORT status fmi2ExitInitializationMode(instance c)
{
    component_begin(c);
    return OK;
}

EXPORT status fmi2Terminate(instance c)
{
    (void)c;
    return OK;
}

EXPORT status fmi2Reset(instance c)
{
    component_reset(c);
    return OK;
}

EXPORT status fmi2GetReal(instance c, const reference which[], size_t n, double value[])
{
    for (size_t k = 0; k < n; ++k) {
        if (!component_get(c, which[k], value + k)) {
            return ERROR;
        }
    }
    return OK;
}

EXPORT status fmi2SetReal(instance c, const reference which[], size_t n, const double value[])
{
    for (size_t k = 0; k < n; ++k) {
        if (!component_set(c, which[k], value[k])) {
            return ERROR;
        }
    }
    return OK;
}

EXPORT status fmi2GetInteger(instance c, const reference which[], size_t n, int value[])
{
    for (size_t k = 0; k < n; ++k) {
        if (!component_get_integer(c, which[k], value + k)) {
            return ERROR;
        }
    }
    return OK;
}

#define NONE(name, type)                                                                                               \
    EXPORT status name(instance c, const reference which[], size_t n, type value[])                                    \
    {                                                                                                                  \
        (void)c, (void)which, (void)value;                                                                             \
        return n ? ERROR : OK;                                                                                         \
    }
NONE(fmi2GetBoolean, int)
NONE(fmi2GetString, const char *)
NONE(fmi2SetInteger, const int)
NONE(fmi2SetBoolean, const int)
NONE(fmi2SetString, const char *const)

EXPORT status fmi2GetFMUstate(instance c, void **state)
{
    free(*state);
    *state = component_copy(c);
    return *state ? OK : ERROR;
}

EXPORT status fmi2SetFMUstate(instance c, void *state)
{
    memcpy(c, state, sizeof(component));
    return OK;
}

EXPORT status fmi2FreeFMUstate(instance c, void **state)
{
    (void)c;
    free(*state);
    *state = NULL;
    return OK;
}

EXPORT status fmi2SerializedFMUstateSize(instance c, void *state, size_t *size)
{
    (void)c, (void)state;
    *size = sizeof(component);
    return OK;
}

EXPORT status fmi2SerializeFMUstate(instance c, void *state, char bytes[], size_t size)
{
    (void)c;
    if (size < sizeof(component)) {
        return ERROR;
    }
    memcpy(bytes, state, sizeof(component));
    return OK;
}

EXPORT status fmi2DeSerializeFMUstate(instance c, const char bytes[], size_t size, void **state)
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

EXPORT status fmi2GetDirectionalDerivative(instance c, const reference of[], size_t m, const reference by[], size_t n,
                                           const double seed[], double value[])
{
    (void)c, (void)of, (void)m, (void)by, (void)n, (void)seed, (void)value;
    return ERROR;
}

EXPORT status fmi2SetRealInputDerivatives(instance c, const reference which[], size_t n, const int order[],
                                          const double value[])
{
    (void)c, (void)which, (void)n, (void)order, (void)value;
    return ERROR;
}

EXPORT status fmi2GetRealOutputDerivatives(instance c, const reference which[], size_t n, const int order[],
                                           double value[])
{
    (void)c, (void)which, (void)n, (void)order, (void)value;
    return ERROR;
}

EXPORT status fmi2DoStep(instance c, double now, double step, int final)
{
    (void)final;
    if (!(step > 0.0)) {
        return ERROR;
    }
    component_step(c, step);
    ((component *)c)->time = now + step;
    return STATUS(&((component *)c)->network) ? WARNING : OK;
}

EXPORT status fmi2CancelStep(instance c)
{
    (void)c;
    return ERROR;
}

#define NO_STATUS(name, type)                                                                                          \
    EXPORT status name(instance c, int kind, type *value)                                                              \
    {                                                                                                                  \
        (void)c, (void)kind, (void)value;                                                                              \
        return DISCARD;                                                                                                \
    }
NO_STATUS(fmi2GetStatus, status)
NO_STATUS(fmi2GetRealStatus, double)
NO_STATUS(fmi2GetIntegerStatus, int)
NO_STATUS(fmi2GetBooleanStatus, int)
NO_STATUS(fmi2GetStringStatus, const char *)
