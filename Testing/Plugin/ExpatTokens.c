/* SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
 * SPDX-License-Identifier: BSD-3-Clause */
/* For LD_PRELOAD: has parsers of a libexpat newer than 2.5.0-1+deb12u1 hand out tokens as soon as
 * they can, as older ones do. ParaView 5.11 stops feeding its parser at the tag after which raw data
 * follows, and fails if that tag has not been handed out. Does nothing with an older libexpat. */
#define _GNU_SOURCE
#include <dlfcn.h>

typedef struct XML_ParserStruct* XML_Parser;

XML_Parser XML_ParserCreate(const char* encoding)
{
  XML_Parser (*create)(const char*) = (XML_Parser(*)(const char*))dlsym(RTLD_NEXT, __func__);
  XML_Parser parser = create ? create(encoding) : 0;
  unsigned char (*defer)(XML_Parser, unsigned char) =
    (unsigned char (*)(XML_Parser, unsigned char))dlsym(
      RTLD_DEFAULT, "XML_SetReparseDeferralEnabled");
  if (parser && defer)
  {
    defer(parser, 0);
  }
  return parser;
}
