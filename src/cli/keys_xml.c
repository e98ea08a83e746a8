/* SPDX-License-Identifier: Apache-2.0 */
/* XML through expat: the outermost element is not a part of the names; words of text are a sequence. */
#include "keys.h"

#include <string.h>

#ifdef HAVE_EXPAT
#include <expat.h>

enum { MOST_TEXT = 16384 };

typedef struct walk {
    keys *k;
    char name[KEYS_NAME];
    size_t lengths[KEYS_DEPTH]; /* of the name, by depth */
    int depth;
    char text[MOST_TEXT];
    size_t length;
    const char *wrong;
} walk;

static void XMLCALL begin(void *data, const XML_Char *element, const XML_Char **attributes)
{
    walk *w = data;
    const size_t at = w->depth > 1 ? w->lengths[w->depth] + 1 : 0;
    (void)attributes;
    if (w->depth + 1 >= KEYS_DEPTH || at + strlen(element) + 16 > KEYS_NAME) {
        w->wrong = KEYS_TOO_MUCH;
        return;
    }
    if (w->depth > 0) {
        if (at > 0) {
            w->name[at - 1] = '.';
        }
        strcpy(w->name + at, element);
    }
    w->depth++;
    w->lengths[w->depth] = strlen(w->name);
    w->length = 0;
}

static void XMLCALL text(void *data, const XML_Char *bytes, int length)
{
    walk *w = data;
    if (w->length + (size_t)length >= MOST_TEXT) {
        w->wrong = KEYS_TOO_MUCH;
        return;
    }
    memcpy(w->text + w->length, bytes, (size_t)length);
    w->length += (size_t)length;
}

/* One word is the element's value; several are a sequence. */
static void add_words(walk *w)
{
    static const char SPACE[] = " \t\r\n";
    const char *at = w->text;
    const size_t stem = strlen(w->name);
    int place = 0;
    w->text[w->length] = '\0';
    for (at += strspn(at, SPACE); *at != '\0'; at += strspn(at, SPACE)) {
        const size_t length = strcspn(at, SPACE);
        if (place == 0 && at[length + strspn(at + length, SPACE)] == '\0' && !keys_add(w->k, w->name, at, length)) {
            w->wrong = KEYS_TOO_MUCH;
        }
        snprintf(w->name + stem, KEYS_NAME - stem, ".%d", place++);
        if (!keys_add(w->k, w->name, at, length)) {
            w->wrong = KEYS_TOO_MUCH;
        }
        w->name[stem] = '\0';
        at += length;
    }
}

static void XMLCALL end(void *data, const XML_Char *element)
{
    walk *w = data;
    (void)element;
    if (w->wrong != NULL) {
        return;
    }
    add_words(w);
    w->length = 0;
    w->depth--;
    w->name[w->depth > 0 ? w->lengths[w->depth] : 0] = '\0';
}

const char *keys_read_xml(keys *k, FILE *in)
{
    static walk w; /* 16 KiB of text */
    XML_Parser parser = XML_ParserCreate(NULL);
    char buffer[4096];
    int last = 0;
    memset(&w, 0, sizeof w);
    w.k = k;
    if (parser == NULL) {
        return "out of memory";
    }
    XML_SetUserData(parser, &w);
    XML_SetElementHandler(parser, begin, end);
    XML_SetCharacterDataHandler(parser, text);
    while (!last && w.wrong == NULL) {
        const size_t n = fread(buffer, 1, sizeof buffer, in);
        last = n < sizeof buffer;
        if (XML_Parse(parser, buffer, (int)n, last) == XML_STATUS_ERROR && w.wrong == NULL) {
            w.wrong = "is no sound XML";
        }
    }
    XML_ParserFree(parser);
    return w.wrong;
}

#else

const char *keys_read_xml(keys *k, FILE *in)
{
    (void)k;
    (void)in;
    return "XML is not read: this program was built without expat";
}

#endif
