/* SPDX-License-Identifier: Apache-2.0 */
/* The manifest of the golden vectors, checked field by field, and the files it names. */
#include "vectors_fields.h"

#include <stdio.h>
#include <string.h>

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
static int read_shape(const vectors_reader *r, conf_array *a, const cJSON *json, const char *file)
{
    int image = ends_with(file, ".png");
    int32_t value = 0;
    if (!image && !ends_with(file, ".hex")) {
        return vectors_fail(r, "field 'file': %s is neither .hex nor .png", file);
    }
    if (cJSON_HasObjectItem(json, "width") != image || cJSON_HasObjectItem(json, "height") != image) {
        return vectors_fail(r, "fields 'width' and 'height' %s", image ? "are missing" : "are for images only");
    }
    if (!vectors_number(r, &value, json, "bits", 8, 64)) {
        return 0;
    }
    a->bits = (int)value;
    if (image ? value != 8 : value != 8 && value != 16 && value != 32 && value != 64) {
        return vectors_fail(r, "field 'bits': %ld is not %s", (long)value,
                            image ? "8, as for images" : "8, 16, 32 or 64");
    }
    if (image) {
        if (!vectors_number(r, &a->width_px, json, "width", 1, 65535) ||
            !vectors_number(r, &a->height_px, json, "height", 1, 65535)) {
            return 0;
        }
        a->count = (size_t)a->width_px * (size_t)a->height_px;
    }
    if (!image || cJSON_HasObjectItem(json, "count")) {
        if (!vectors_number(r, &value, json, "count", 0, INT32_MAX)) {
            return 0;
        }
        if (image && a->count != (size_t)value) {
            return vectors_fail(r, "field 'count' is not width times height");
        }
        a->count = (size_t)value;
    }
    return !cJSON_HasObjectItem(json, "q") || vectors_number(r, &value, json, "q", 0, 63);
}

/* --- arrays --- */

static int read_array(vectors_reader *r, conf_array *a, const char **file, const cJSON *json, const char *more)
{
    char optional[64];
    char path[1024];
    char reason[VECTORS_TEXT];
    const char *digest;
    snprintf(optional, sizeof optional, "count width height q %s", more);
    r->array = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(json, "name"));
    if (!vectors_fields(r, json, "name file bits sha256", optional)) {
        return 0;
    }
    a->name = vectors_text(r, json, "name");
    *file = vectors_text(r, json, "file");
    digest = vectors_text(r, json, "sha256");
    if (a->name == NULL || *file == NULL || digest == NULL) {
        return 0;
    }
    if (!plain_path(*file)) {
        return vectors_fail(r, "field 'file': %s leaves the folder or has unusual characters", *file);
    }
    if (!read_shape(r, a, json, *file)) {
        return 0;
    }
    snprintf(path, sizeof path, "%s/%s", r->directory, *file);
    if (!vectors_data(a, reason, path, digest)) {
        return vectors_fail(r, "file %s: %s", *file, reason);
    }
    r->array = NULL;
    return 1;
}

static int read_expected(vectors_reader *r, conf_expected *e, const char **file, const cJSON *json)
{
    static const uint64_t zero = 0;
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(json, "name"));
    const cJSON *bound = cJSON_GetObjectItemCaseSensitive(json, "bound");
    const char *class;
    if (!read_array(r, &e->array, file, json, "class bound")) {
        return 0;
    }
    r->array = name;
    class = vectors_text(r, json, "class");
    if (class == NULL) {
        return 0;
    }
    if (!vectors_listed(strcmp(r->tier, "exact") == 0 ? "exact" : "exact lsb", class)) {
        return vectors_fail(r, "field 'class': '%s' is not what this tier has", class);
    }
    e->bound = &zero;
    e->bound_count = 1;
    if (strcmp(class, "lsb") != 0) {
        return bound == NULL ? 1 : vectors_fail(r, "field 'bound' without class lsb");
    }
    return bound != NULL ? vectors_bound(r, e, bound) : vectors_fail(r, "field 'bound' is missing");
}

/* The items of a tier, one at least and at most 'most'; -1 on failure. */
static int tier_size(vectors_reader *r, const cJSON *json, const char *tier, int most)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(json, tier);
    int size = cJSON_IsArray(list) ? cJSON_GetArraySize(list) : -1;
    r->tier = tier;
    r->array = NULL;
    if (size < 1 || size > most) {
        vectors_fail(r, "a list of 1 to %d arrays is expected", most);
        return -1;
    }
    return size;
}

static int read_inputs(vectors_reader *r, conf_case *c, const cJSON *json)
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

static int read_tier(vectors_reader *r, const conf_expected **out, int *count, const char **file, const cJSON *json,
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
                return vectors_fail(r, "this name is there twice");
            }
        }
        i++;
    }
    return 1;
}

/* --- cases --- */

static int check_labels(const vectors_reader *r, const cJSON *json)
{
    const cJSON *flags = cJSON_GetObjectItemCaseSensitive(json, "flags");
    const cJSON *origin = cJSON_GetObjectItemCaseSensitive(json, "origin");
    const cJSON *item = NULL;
    const cJSON *seed;
    if (!cJSON_IsArray(flags)) {
        return vectors_fail(r, "field 'flags' is no list");
    }
    cJSON_ArrayForEach(item, flags)
    {
        if (!cJSON_IsString(item)) {
            return vectors_fail(r, "field 'flags' holds what is no text");
        }
    }
    if (!vectors_fields(r, origin, "seed generator", "")) {
        return 0;
    }
    seed = cJSON_GetObjectItemCaseSensitive(origin, "seed");
    /* 64 bits: more than a double tells apart; it is whole from 2^53 on. */
    if (!vectors_whole(seed, 0, 9007199254740992.0) &&
        !(cJSON_IsNumber(seed) && seed->valuedouble > 9007199254740992.0 &&
          seed->valuedouble <= 18446744073709551616.0)) {
        return vectors_fail(r, "field 'seed' is no whole number of 64 bits");
    }
    return vectors_text(r, origin, "generator") != NULL;
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

/* Every output has a class: none goes without the reference unsaid. */
static int check_classes(vectors_reader *r, const conf_case *c)
{
    int i;
    int k;
    for (i = 0; i < c->exact_count; i++) {
        for (k = 0; k < c->reference_count; k++) {
            if (strcmp(c->reference[k].array.name, c->exact[i].array.name) == 0) {
                break;
            }
        }
        if (k == c->reference_count) {
            r->tier = "reference";
            r->array = NULL;
            return vectors_fail(r, "output %s has no class", c->exact[i].array.name);
        }
    }
    return 1;
}

static int read_case(vectors_reader *r, vectors_case *out, const cJSON *json)
{
    conf_case *c = &out->run;
    const char *reference_file[CONF_MAX_OUTPUTS];
    r->tier = r->array = NULL;
    r->id = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(json, "id"));
    if (!vectors_fields(r, json, "id stage tier flags origin inputs reference exact", "")) {
        return 0;
    }
    c->id = vectors_text(r, json, "id");
    c->stage = vectors_text(r, json, "stage");
    c->tier = vectors_text(r, json, "tier");
    if (c->id == NULL || c->stage == NULL || c->tier == NULL) {
        return 0;
    }
    if (!known_stage(c->stage)) {
        return vectors_fail(r, "field 'stage': there is no stage '%s'", c->stage);
    }
    if (strncmp(c->id, c->stage, strlen(c->stage)) != 0 || c->id[strlen(c->stage)] != '/') {
        return vectors_fail(r, "field 'id' does not begin with the stage's name and a slash");
    }
    if (!vectors_listed("ordinary boundary stress must-reject", c->tier)) {
        return vectors_fail(r, "field 'tier': '%s' is unknown", c->tier);
    }
    r->stage = c->stage;
    return check_labels(r, json) && read_inputs(r, c, json) &&
           read_tier(r, &c->reference, &c->reference_count, reference_file, json, "reference") &&
           read_tier(r, &c->exact, &c->exact_count, out->exact_file, json, "exact") && check_classes(r, c);
}

static int check_version(const vectors_reader *r, const char *version)
{
    char path[1024];
    char reason[VECTORS_TEXT];
    char *text;
    size_t bytes;
    snprintf(path, sizeof path, "%s/VERSION", r->directory);
    text = vectors_file(&bytes, reason, path);
    if (text == NULL) {
        return vectors_fail(r, "file VERSION: %s", reason);
    }
    text[strcspn(text, "\r\n")] = '\0';
    return strcmp(text, version) == 0
               ? 1
               : vectors_fail(r, "field 'version' is '%s', file VERSION says '%s'", version, text);
}

static int read_cases(vectors_reader *r, vectors *out, const cJSON *list)
{
    const cJSON *item = NULL;
    size_t k;
    if (!cJSON_IsArray(list) || list->child == NULL) {
        return vectors_fail(r, "field 'cases' is no list, or empty");
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
                return vectors_fail(r, "this id is there twice");
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
    vectors_reader r = {NULL, NULL, NULL, NULL, NULL};
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
        return vectors_fail(&r, "%s", reason);
    }
    cJSON_InitHooks(&hooks);
    json = cJSON_ParseWithLengthOpts(text, bytes + 1, NULL, 1);
    if (json == NULL) {
        return vectors_fail(&r, "is no JSON at byte %ld", (long)(cJSON_GetErrorPtr() - text));
    }
    if (!vectors_fields(&r, json, "schema version opencv cases", "")) {
        return 0;
    }
    out->version = vectors_text(&r, json, "version");
    if (out->version == NULL || vectors_text(&r, json, "opencv") == NULL || vectors_text(&r, json, "schema") == NULL) {
        return 0;
    }
    if (strcmp(vectors_text(&r, json, "schema"), "manifest.schema.json") != 0) {
        return vectors_fail(&r, "field 'schema' is not manifest.schema.json");
    }
    return check_version(&r, out->version) && read_cases(&r, out, cJSON_GetObjectItemCaseSensitive(json, "cases"));
}
