/* Point caches. PC2, little-endian: "POINTCACHE2" and a zero byte, version, points, first frame, frames
 * per sample, samples; then positions. MDD, big-endian: samples, points, the samples' times; then
 * positions. */
#include <string.h>

#include "base/file.h"
#include "sbfmt/export.h"

struct sbf_point_cache {
  sbfi_file_writer writer;
  sbf_allocator allocator;
  uint32_t point_count, sample_count, written;
  bool big_endian; /* MDD */
  char path[1024];
};

static void put_u32(const sbf_point_cache *cache, uint8_t *to, uint32_t value) {
  for (int i = 0; i < 4; i++) to[cache->big_endian ? 3 - i : i] = (uint8_t)(value >> (8 * i));
}

static void put_f32(const sbf_point_cache *cache, uint8_t *to, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  put_u32(cache, to, bits);
}

static sbf_status write_pc2_header(sbf_point_cache *cache, sbf_diagnostic *error) {
  uint8_t header[32] = "POINTCACHE2";
  put_u32(cache, header + 12, 1);
  put_u32(cache, header + 16, cache->point_count);
  put_f32(cache, header + 20, 0);
  put_f32(cache, header + 24, 1);
  put_u32(cache, header + 28, cache->sample_count);
  return sbfi_file_writer_write(&cache->writer, header, sizeof header, error);
}

static sbf_status write_mdd_header(sbf_point_cache *cache, double sample_s, sbf_diagnostic *error) {
  uint8_t piece[8];
  put_u32(cache, piece, cache->sample_count);
  put_u32(cache, piece + 4, cache->point_count);
  sbf_status status = sbfi_file_writer_write(&cache->writer, piece, 8, error);
  for (uint32_t i = 0; i < cache->sample_count && status == SBF_OK; i++) {
    put_f32(cache, piece, (float)(i * sample_s));
    status = sbfi_file_writer_write(&cache->writer, piece, 4, error);
  }
  return status;
}

static bool is_mdd(const char *path) {
  const char *ending = strrchr(path, '.');
  return ending && strcmp(ending, ".mdd") == 0;
}

sbf_status sbf_point_cache_open(const char *path, uint32_t point_count, uint32_t sample_count,
    double sample_s, sbf_point_cache **cache, sbf_diagnostic *error) {
  sbf_allocator allocator = sbfi_allocator_or_default(NULL);
  *cache = NULL;
  sbf_point_cache *made = sbfi_allocate(&allocator, sizeof *made);
  if (!made)
    return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for the point cache %s", path);
  *made = (sbf_point_cache){.allocator = allocator,
      .point_count = point_count,
      .sample_count = sample_count,
      .big_endian = is_mdd(path)};
  sbfi_copy_text(made->path, sizeof made->path, path);
  sbf_status status = sbfi_file_writer_open(&made->writer, made->path, &allocator, error);
  if (status == SBF_OK)
    status = made->big_endian ? write_mdd_header(made, sample_s, error) : write_pc2_header(made, error);
  if (status == SBF_OK)
    *cache = made;
  else
    sbf_point_cache_abandon(made);
  return status;
}

sbf_status sbf_point_cache_add(sbf_point_cache *cache, const sbf_vec3 *points, sbf_diagnostic *error) {
  if (cache->written == cache->sample_count)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the point cache %s has all its samples", cache->path);
  enum { BLOCK = 256 };
  uint8_t bytes[BLOCK * 12];
  for (uint32_t done = 0; done < cache->point_count;) {
    uint32_t count = cache->point_count - done < BLOCK ? cache->point_count - done : BLOCK;
    for (uint32_t i = 0; i < count; i++) {
      put_f32(cache, bytes + 12 * i, points[done + i].x);
      put_f32(cache, bytes + 12 * i + 4, points[done + i].y);
      put_f32(cache, bytes + 12 * i + 8, points[done + i].z);
    }
    sbf_status status = sbfi_file_writer_write(&cache->writer, bytes, 12 * (size_t)count, error);
    if (status != SBF_OK) return status;
    done += count;
  }
  cache->written++;
  return SBF_OK;
}

sbf_status sbf_point_cache_commit(sbf_point_cache *cache, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  if (cache->written != cache->sample_count) {
    status = sbfi_diagnose(error, SBF_CODE_BAD_CALL, "the point cache %s got %u of %u samples", cache->path,
        cache->written, cache->sample_count);
    sbfi_file_writer_abandon(&cache->writer);
  } else {
    status = sbfi_file_writer_commit(&cache->writer, error);
  }
  sbf_allocator allocator = cache->allocator;
  sbfi_free(&allocator, cache, sizeof *cache);
  return status;
}

void sbf_point_cache_abandon(sbf_point_cache *cache) {
  if (!cache) return;
  sbfi_file_writer_abandon(&cache->writer);
  sbf_allocator allocator = cache->allocator;
  sbfi_free(&allocator, cache, sizeof *cache);
}
