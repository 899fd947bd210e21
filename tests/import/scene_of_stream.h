/* Scenes put together from streams that tests write. */
#ifndef TEST_SCENE_OF_STREAM_H
#define TEST_SCENE_OF_STREAM_H

#include "import/scene/scene.h"
#include "stream_builder.h"

/* As if the stream came of a file of this format; frees the stream. The test fails where the scene is not
 * sound. */
void scene_of_stream(sbfi_scene *scene, stream_builder *s, const char *format);

#endif
