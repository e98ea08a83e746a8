/* SPDX-License-Identifier: Apache-2.0 */
/* The manifest of the golden vectors, checked field by field, and the files it names. */
#include "vectors.h"

#include <cjson/cJSON.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Where in the manifest we are, for messages; unused ones are NULL. */
typedef struct reader {
    const char *directory;
    const char *id;
    const char *tier; /* inputs, reference, exact */
    const char *array;
} reader;

static int fail(const reader *r, const char *format, ...)
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

/* Is the word one of a list of words, separated by single spaces? */
static int listed(const char *list, const char *word)
{
    size_t length = strlen(word);
    const char *at = list;
    while (at != NULL && (strncmp(at, word, length) != 0 || (at[length] != ' ' && at[length] != '\0'))) {
        at = strchr(at, ' ');
        at = at != NULL ? at + 1 : NULL;
    }
    return at != NULL && length > 0;
}

/* Every required field once, none that is neither required nor optional. */
static int check_fields(const reader *r, const cJSON *object, const char *required, const char *optional)
{
    const cJSON *item;
    const char *at = required;
    if (!cJSON_IsObject(object)) {
        return fail(r, "an object is expected");
    }
    cJSON_ArrayForEach(item, object)
    {
        if (!listed(required, item->string) && !listed(optional, item->string)) {
            return fail(r, "unknown field '%s'", item->string);
        }
        if (cJSON_GetObjectItemCaseSensitive(object, item->string) != item) {
            return fail(r, "field '%s' is there twice", item->string);
        }
    }
    while (*at != '\0') {
        char name[32];
        size_t length = strcspn(at, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        if (!cJSON_HasObjectItem(object, name)) {
            return fail(r, "field '%s' is missing", name);
        }
        at += length + (at[length] == ' ');
    }
    return 1;
}

static const char *text_of(const reader *r, const cJSON *object, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!cJSON_IsString(item) || item->valuestring[0] == '\0') {
        fail(r, "field '%s' is no text", name);
        return NULL;
    }
    return item->valuestring;
}

static int whole(const cJSON *item, double low, double high)
{
    return cJSON_IsNumber(item) && item->valuedouble >= low && item->valuedouble <= high &&
           item->valuedouble == (double)(int64_t)item->valuedouble;
}

static int number_of(const reader *r, int32_t *out, const cJSON *object, const char *name, int32_t low, int32_t high)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!whole(item, low, high)) {
        return fail(r, "field '%s' is no whole number in [%ld, %ld]", name, (long)low, (long)high);
    }
    *out = (int32_t)item->valuedouble;
    return 1;
}

/* --- names of files --- */

static int ends_with(const char *text, const char *end)
{
    size_t length = strlen(text);
    return length > strlen(end) && strcmp(text + length - strlen(end), end) == 0;
}

/* A path inside the folder, of plain components. */
static int plain_path(const char *file)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./";
    return file[0] != '/' && strstr(file, "..") == NULL && file[strspn(file, plain)] == '\0';
}

/* Size of an image or number of words, fields that go with the kind of file. */
static int read_shape(const reader *r, conf_array *a, const cJSON *json, const char *file)
{
    int image = ends_with(file, ".png");
    int32_t value = 0;
    if (!image && !ends_with(file, ".hex")) {
        return fail(r, "field 'file': %s is neither .hex nor .png", file);
    }
    if (cJSON_HasObjectItem(json, "width") != image || cJSON_HasObjectItem(json, "height") != image) {
        return fail(r, "fields 'width' and 'height' %s", image ? "are missing" : "are for images only");
    }
    if (!number_of(r, &value, json, "bits", 8, 64)) {
        return 0;
    }
    a->bits = (int)value;
    if (image ? value != 8 : value != 8 && value != 16 && value != 32 && value != 64) {
        return fail(r, "field 'bits': %ld is not %s", (long)value, image ? "8, as for images" : "8, 16, 32 or 64");
    }
    if (image) {
        if (!number_of(r, &a->width_px, json, "width", 1, 65535) ||
            !number_of(r, &a->height_px, json, "height", 1, 65535)) {
            return 0;
        }
        a->count = (size_t)a->width_px * (size_t)a->height_px;
    }
    if (!image || cJSON_HasObjectItem(json, "count")) {
        if (!number_of(r, &value, json, "count", 0, INT32_MAX)) {
            return 0;
        }
        if (image && a->count != (size_t)value) {
            return fail(r, "field 'count' is not width times height");
        }
        a->count = (size_t)value;
    }
    return !cJSON_HasObjectItem(json, "q") || number_of(r, &value, json, "q", 0, 63);
}

/* --- arrays --- */

static int read_array(reader *r, conf_array *a, const char **file, const cJSON *json, const char *more)
{
    char optional[64];
    char path[1024];
    char reason[VECTORS_TEXT];
    const char *digest;
    snprintf(optional, sizeof optional, "count width height q %s", more);
    r->array = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(json, "name"));
    if (!check_fields(r, json, "name file bits sha256", optional)) {
        return 0;
    }
    a->name = text_of(r, json, "name");
    *file = text_of(r, json, "file");
    digest = text_of(r, json, "sha256");
    if (a->name == NULL || *file == NULL || digest == NULL) {
        return 0;
    }
    if (!plain_path(*file)) {
        return fail(r, "field 'file': %s leaves the folder or has unusual characters", *file);
    }
    if (!read_shape(r, a, json, *file)) {
        return 0;
    }
    snprintf(path, sizeof path, "%s/%s", r->directory, *file);
    if (!vectors_data(a, reason, path, digest)) {
        return fail(r, "file %s: %s", *file, reason);
    }
    r->array = NULL;
    return 1;
}

static int read_bound(const reader *r, conf_expected *e, const cJSON *bound)
{
    const cJSON *item = cJSON_IsArray(bound) ? bound->child : bound;
    uint32_t *values;
    size_t i;
    e->bound_count = cJSON_IsArray(bound) ? (size_t)cJSON_GetArraySize(bound) : 1;
    values = vectors_alloc(e->bound_count * sizeof *values);
    for (i = 0; i < e->bound_count; i++, item = item->next) {
        if (!whole(item, 0, UINT32_MAX)) {
            return fail(r, "field 'bound' is no whole number of LSB, nor a list of them");
        }
        values[i] = (uint32_t)item->valuedouble;
    }
    e->bound = values;
    return e->bound_count > 0 ? 1 : fail(r, "field 'bound' is empty");
}

static int read_expected(reader *r, conf_expected *e, const char **file, const cJSON *json)
{
    static const uint32_t zero = 0;
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(json, "name"));
    const cJSON *bound = cJSON_GetObjectItemCaseSensitive(json, "bound");
    const char *class;
    if (!read_array(r, &e->array, file, json, "class bound")) {
        return 0;
    }
    r->array = name;
    class = text_of(r, json, "class");
    if (class == NULL) {
        return 0;
    }
    if (!listed(strcmp(r->tier, "exact") == 0 ? "exact" : "exact lsb", class)) {
        return fail(r, "field 'class': '%s' is not what this tier has", class);
    }
    e->bound = &zero;
    e->bound_count = 1;
    if (strcmp(class, "lsb") != 0) {
        return bound == NULL ? 1 : fail(r, "field 'bound' without class lsb");
    }
    return bound != NULL ? read_bound(r, e, bound) : fail(r, "field 'bound' is missing");
}

/* The items of a tier, one at least and at most 'most'; -1 on failure. */
static int tier_size(reader *r, const cJSON *json, const char *tier, int most)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(json, tier);
    int size = cJSON_IsArray(list) ? cJSON_GetArraySize(list) : -1;
    r->tier = tier;
    r->array = NULL;
    if (size < 1 || size > most) {
        fail(r, "a list of 1 to %d arrays is expected", most);
        return -1;
    }
    return size;
}

static int read_inputs(reader *r, conf_case *c, const cJSON *json)
{
    const cJSON *item = NULL;
    conf_array *inputs = vectors_alloc(CONF_MAX_INPUTS * sizeof *inputs);
    const char *file;
    int i = 0;
    c->inputs = inputs;
    c->input_count = tier_size(r, json, "inputs", CONF_MAX_INPUTS);
    if (c->input_count < 0) {
        return 0;
    }
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(json, "inputs"))
    {
        if (!read_array(r, &inputs[i++], &file, item, "")) {
            return 0;
        }
    }
    return 1;
}

static int read_tier(reader *r, const conf_expected **out, int *count, const char **file, const cJSON *json,
                     const char *tier)
{
    const cJSON *item = NULL;
    conf_expected *expected = vectors_alloc(CONF_MAX_OUTPUTS * sizeof *expected);
    int i = 0;
    int k;
    *out = expected;
    *count = tier_size(r, json, tier, CONF_MAX_OUTPUTS);
    if (*count < 0) {
        return 0;
    }
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(json, tier))
    {
        if (!read_expected(r, &expected[i], &file[i], item)) {
            return 0;
        }
        for (k = 0; k < i; k++) {
            if (strcmp(expected[k].array.name, expected[i].array.name) == 0) {
                return fail(r, "this name is there twice");
            }
        }
        i++;
    }
    return 1;
}

/* --- cases --- */

static int check_labels(const reader *r, const cJSON *json)
{
    const cJSON *flags = cJSON_GetObjectItemCaseSensitive(json, "flags");
    const cJSON *origin = cJSON_GetObjectItemCaseSensitive(json, "origin");
    const cJSON *item = NULL;
    const cJSON *seed;
    if (!cJSON_IsArray(flags)) {
        return fail(r, "field 'flags' is no list");
    }
    cJSON_ArrayForEach(item, flags)
    {
        if (!cJSON_IsString(item)) {
            return fail(r, "field 'flags' holds what is no text");
        }
    }
    if (!check_fields(r, origin, "seed generator", "")) {
        return 0;
    }
    seed = cJSON_GetObjectItemCaseSensitive(origin, "seed");
    /* 64 bits: more than a double tells apart; it is whole from 2^53 on. */
    if (!whole(seed, 0, 9007199254740992.0) && !(cJSON_IsNumber(seed) && seed->valuedouble > 9007199254740992.0 &&
                                                 seed->valuedouble <= 18446744073709551616.0)) {
        return fail(r, "field 'seed' is no whole number of 64 bits");
    }
    return text_of(r, origin, "generator") != NULL;
}

static int known_stage(const char *stage)
{
    int i;
    for (i = 0; i < conf_stage_count(); i++) {
        if (strcmp(conf_stage_name(i), stage) == 0) {
            return 1;
        }
    }
    return 0;
}

static int read_case(reader *r, vectors_case *out, const cJSON *json)
{
    conf_case *c = &out->run;
    const char *reference_file[CONF_MAX_OUTPUTS];
    r->tier = r->array = NULL;
    r->id = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(json, "id"));
    if (!check_fields(r, json, "id stage tier flags origin inputs reference exact", "")) {
        return 0;
    }
    c->id = text_of(r, json, "id");
    c->stage = text_of(r, json, "stage");
    c->tier = text_of(r, json, "tier");
    if (c->id == NULL || c->stage == NULL || c->tier == NULL) {
        return 0;
    }
    if (!known_stage(c->stage)) {
        return fail(r, "field 'stage': there is no stage '%s'", c->stage);
    }
    if (strncmp(c->id, c->stage, strlen(c->stage)) != 0 || c->id[strlen(c->stage)] != '/') {
        return fail(r, "field 'id' does not begin with the stage's name and a slash");
    }
    if (!listed("ordinary boundary stress must-reject", c->tier)) {
        return fail(r, "field 'tier': '%s' is unknown", c->tier);
    }
    return check_labels(r, json) && read_inputs(r, c, json) &&
           read_tier(r, &c->reference, &c->reference_count, reference_file, json, "reference") &&
           read_tier(r, &c->exact, &c->exact_count, out->exact_file, json, "exact");
}

static int check_version(const reader *r, const char *version)
{
    char path[1024];
    char reason[VECTORS_TEXT];
    char *text;
    size_t bytes;
    snprintf(path, sizeof path, "%s/VERSION", r->directory);
    text = vectors_file(&bytes, reason, path);
    if (text == NULL) {
        return fail(r, "file VERSION: %s", reason);
    }
    text[strcspn(text, "\r\n")] = '\0';
    return strcmp(text, version) == 0 ? 1 : fail(r, "field 'version' is '%s', file VERSION says '%s'", version, text);
}

static int read_cases(reader *r, vectors *out, const cJSON *list)
{
    const cJSON *item = NULL;
    size_t k;
    if (!cJSON_IsArray(list) || list->child == NULL) {
        return fail(r, "field 'cases' is no list, or empty");
    }
    out->cases = vectors_alloc((size_t)cJSON_GetArraySize(list) * sizeof *out->cases);
    cJSON_ArrayForEach(item, list)
    {
        vectors_case *c = &out->cases[out->count];
        if (!read_case(r, c, item)) {
            return 0;
        }
        for (k = 0; k < out->count; k++) {
            if (strcmp(out->cases[k].run.id, c->run.id) == 0) {
                r->tier = r->array = NULL;
                return fail(r, "this id is there twice");
            }
        }
        out->count++;
    }
    return 1;
}

static void no_free(void *p) { (void)p; /* vectors_free() does it: the cases point into the tree */ }

int vectors_read(vectors *out, const char *directory)
{
    cJSON_Hooks hooks = {vectors_alloc, no_free};
    reader r = {NULL, NULL, NULL, NULL};
    char path[1024];
    char reason[VECTORS_TEXT];
    char *text;
    size_t bytes;
    const cJSON *json;
    memset(out, 0, sizeof *out);
    r.directory = directory;
    snprintf(path, sizeof path, "%s/manifest.json", directory);
    text = vectors_file(&bytes, reason, path);
    if (text == NULL) {
        return fail(&r, "%s", reason);
    }
    cJSON_InitHooks(&hooks);
    json = cJSON_ParseWithLengthOpts(text, bytes + 1, NULL, 1);
    if (json == NULL) {
        return fail(&r, "is no JSON at byte %ld", (long)(cJSON_GetErrorPtr() - text));
    }
    if (!check_fields(&r, json, "schema version opencv cases", "")) {
        return 0;
    }
    out->version = text_of(&r, json, "version");
    if (out->version == NULL || text_of(&r, json, "opencv") == NULL || text_of(&r, json, "schema") == NULL) {
        return 0;
    }
    if (strcmp(text_of(&r, json, "schema"), "manifest.schema.json") != 0) {
        return fail(&r, "field 'schema' is not manifest.schema.json");
    }
    return check_version(&r, out->version) && read_cases(&r, out, cJSON_GetObjectItemCaseSensitive(json, "cases"));
}
