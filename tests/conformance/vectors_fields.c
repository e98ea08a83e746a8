/* SPDX-License-Identifier: Apache-2.0 */
/* Fields of the manifest's objects, and the bounds of an output's words. */
#include "vectors_fields.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int vectors_fail(const vectors_reader *r, const char *format, ...)
{
    va_list arguments;
    fprintf(stderr, "conformance: %s: ", r->id != NULL ? r->id : "manifest.json");
    if (r->tier != NULL) {
        fprintf(stderr, "%s%s%s: ", r->tier, r->array != NULL ? " " : "", r->array != NULL ? r->array : "");
    }
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    return 0;
}

/* --- fields --- */

int vectors_listed(const char *list, const char *word)
{
    size_t length = strlen(word);
    const char *at = list;
    while (at != NULL && (strncmp(at, word, length) != 0 || (at[length] != ' ' && at[length] != '\0'))) {
        at = strchr(at, ' ');
        at = at != NULL ? at + 1 : NULL;
    }
    return at != NULL && length > 0;
}

int vectors_fields(const vectors_reader *r, const cJSON *object, const char *required, const char *optional)
{
    const cJSON *item;
    const char *at = required;
    if (!cJSON_IsObject(object)) {
        return vectors_fail(r, "an object is expected");
    }
    cJSON_ArrayForEach(item, object)
    {
        if (!vectors_listed(required, item->string) && !vectors_listed(optional, item->string)) {
            return vectors_fail(r, "unknown field '%s'", item->string);
        }
        if (cJSON_GetObjectItemCaseSensitive(object, item->string) != item) {
            return vectors_fail(r, "field '%s' is there twice", item->string);
        }
    }
    while (*at != '\0') {
        char name[32];
        size_t length = strcspn(at, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        if (!cJSON_HasObjectItem(object, name)) {
            return vectors_fail(r, "field '%s' is missing", name);
        }
        at += length + (at[length] == ' ');
    }
    return 1;
}

const char *vectors_text(const vectors_reader *r, const cJSON *object, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!cJSON_IsString(item) || item->valuestring[0] == '\0') {
        vectors_fail(r, "field '%s' is no text", name);
        return NULL;
    }
    return item->valuestring;
}

int vectors_whole(const cJSON *item, double low, double high)
{
    return cJSON_IsNumber(item) && item->valuedouble >= low && item->valuedouble <= high &&
           item->valuedouble == (double)(int64_t)item->valuedouble;
}

int vectors_number(const vectors_reader *r, int32_t *out, const cJSON *object, const char *name, int32_t low,
                   int32_t high)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!vectors_whole(item, low, high)) {
        return vectors_fail(r, "field '%s' is no whole number in [%ld, %ld]", name, (long)low, (long)high);
    }
    *out = (int32_t)item->valuedouble;
    return 1;
}

/* --- bounds --- */

/* LSB that a word may differ by, or why it is undefined. */
static int read_bound_item(uint64_t *bound, const cJSON *item)
{
    if (cJSON_IsString(item)) {
        *bound = CONF_UNDEFINED;
        return 1;
    }
    *bound = vectors_whole(item, 0, 9007199254740992.0) ? (uint64_t)item->valuedouble : 0; /* 2^53: exact in JSON */
    return vectors_whole(item, 0, 9007199254740992.0);
}

/* No word without a measure, no bound wider than its measure allows, and undefined only what may be. */
static int check_bounds(const vectors_reader *r, const conf_expected *e, const cJSON *bound)
{
    size_t i;
    for (i = 0; i < e->array.count; i++) {
        const conf_measure *m = conf_measure_of(r->stage, e->array.name, i);
        uint64_t given = e->bound[i % e->bound_count];
        const cJSON *item = cJSON_IsArray(bound) ? cJSON_GetArrayItem(bound, (int)(i % e->bound_count)) : bound;
        if (m == NULL) {
            return vectors_fail(r, "word %lu is none of the stage's", (unsigned long)i);
        }
        if (given == CONF_UNDEFINED) {
            if (m->undefined == NULL || strcmp(m->undefined, item->valuestring) != 0) {
                return vectors_fail(r, "field 'bound': word %lu is not undefined for '%s'", (unsigned long)i,
                                    item->valuestring);
            }
        } else if (m->kind == CONF_UNREFERENCED || given > conf_measure_widest(m, &e->array, i)) {
            return vectors_fail(r, "field 'bound': %llu LSB for word %lu (%s), where %llu is the most",
                                (unsigned long long)given, (unsigned long)i, m->name,
                                (unsigned long long)conf_measure_widest(m, &e->array, i));
        }
    }
    return 1;
}

int vectors_bound(const vectors_reader *r, conf_expected *e, const cJSON *bound)
{
    const cJSON *item = cJSON_IsArray(bound) ? bound->child : bound;
    uint64_t *values;
    size_t i;
    e->bound_count = cJSON_IsArray(bound) ? (size_t)cJSON_GetArraySize(bound) : 1;
    values = vectors_alloc(e->bound_count * sizeof *values);
    for (i = 0; i < e->bound_count; i++, item = item->next) {
        if (!read_bound_item(&values[i], item)) {
            return vectors_fail(r, "field 'bound' is neither whole numbers of LSB nor why a word is undefined");
        }
    }
    e->bound = values;
    return e->bound_count > 0 ? check_bounds(r, e, bound) : vectors_fail(r, "field 'bound' is empty");
}
